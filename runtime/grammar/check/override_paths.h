#pragma once
// The paths of overrides: `net(0, 0, -1)/Node/Chamber[0]`.

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "grammar/check/rule_uses.h"
#include "grammar/check/symbols.h"

namespace sgm {

struct WrittenPath;
struct WrittenStep;

/// The rules that each rule calls, by which the steps of paths are found.
class OverridePaths {
 public:
  /// calls: of all rules that the starts reach.
  OverridePaths(CheckContext& check, const Symbols& symbols, const std::vector<RuleCall>& calls);

  /// Sets layer, cell and steps of an override by path; without steps after an error, or if the missing part of the
  /// text may declare a step.
  void resolve(Override& edit);

 private:
  bool findCell(Override& edit, const WrittenPath& written);
  bool findSteps(const Override& edit, const WrittenPath& written, std::vector<PathStep>& steps);
  bool findStart(const Override& edit, const WrittenStep& step, uint32_t rule);
  bool findCallee(const Override& edit, const WrittenStep& step, uint32_t parent, uint32_t rule);
  uint32_t ruleOf(uint32_t module, const WrittenStep& step) const;
  std::string nameOf(uint32_t rule, NameId qualifier) const;
  void reportUnknown(const Override& edit, const WrittenStep& step, std::string_view who,
                     const std::vector<std::string>& known);

  CheckContext& check_;
  const Symbols& symbols_;
  std::vector<std::set<std::pair<uint32_t, NameId>>> callees_;  ///< of each rule: rules, and their import
};

}  // namespace sgm
