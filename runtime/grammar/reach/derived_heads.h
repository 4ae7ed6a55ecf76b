#pragma once
// Records which heads of rules a derivation can choose.

#include <cstdint>
#include <vector>

#include "grammar/syntax/program.h"
#include "grammar/text/sink.h"

namespace sgm::reach {

/// The set of rule heads that some use of their rule may derive.
class DerivedHeads {
 public:
  explicit DerivedHeads(const Program& program) : derived_(program.rules.size()) {}

  /// Marks a rule as used. Only used rules are checked for idle heads.
  void addRule(uint32_t rule, size_t head_count) { derived_[rule].resize(head_count, false); }
  /// Precondition: addRule().
  void addHead(uint32_t rule, size_t head) { derived_[rule][head] = true; }

  /// Warns of rule heads in the root file that can never be chosen, whatever values the parameters have. Ignores rules
  /// that are not used.
  void warnOfIdle(const Program& program, DiagnosticSink& sink) const;

 private:
  /// by rule and head: whether the head may be derived; empty for rules that are not used
  std::vector<std::vector<bool>> derived_;
};

}  // namespace sgm::reach
