#pragma once
// Resolves the paths of overrides, such as `net(0, 0, -1)/Node/Chamber[0]`.

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

/// Resolves each step of a path to a rule: the first step to the start rule of a layer, each other step to a rule that
/// the rule of the previous step calls.
class OverridePaths {
 public:
  /// calls: the calls in all rules that can be reached from the layers' start calls.
  OverridePaths(CheckContext& check, const Symbols& symbols, const std::vector<RuleCall>& calls);

  /// Sets the layer, the cell and the steps of an override by path. Leaves the steps empty after reporting an error, or
  /// if the rule of a step may be declared in a part of the text that failed to parse.
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
  /// by index of the calling rule: all rules that it calls, each with the import alias in front of its name in the call
  /// (kNoId: none)
  std::vector<std::set<std::pair<uint32_t, NameId>>> callees_;
};

}  // namespace sgm
