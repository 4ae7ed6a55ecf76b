#pragma once
// The heads of rules that a derivation can choose.

#include <cstdint>
#include <vector>

#include "grammar/syntax/program.h"
#include "grammar/text/sink.h"

namespace sgm::reach {

/// Owns the set of heads that some use of their rule may derive.
class DerivedHeads {
 public:
  explicit DerivedHeads(const Program& program) : derived_(program.rules.size()) {}

  /// Marks a rule as used: only heads of used rules are idle.
  void addRule(uint32_t rule, size_t head_count) { derived_[rule].resize(head_count, false); }
  /// Precondition: addRule().
  void addHead(uint32_t rule, size_t head) { derived_[rule][head] = true; }

  /// Warns of heads of the root's rules that no call derives, whatever the parameters are.
  void warnOfIdle(const Program& program, DiagnosticSink& sink) const;

 private:
  std::vector<std::vector<bool>> derived_;  ///< for each rule; empty: not used
};

}  // namespace sgm::reach
