#pragma once
// Checks overrides: their blocks, the targets that they replace, and the rules in which they may apply.

#include <cstdint>
#include <set>
#include <vector>

#include "grammar/check/rule_types.h"
#include "grammar/check/statements.h"

namespace sgm {

/// Collects the rules and layers that each override's block uses, and finds the overrides that may apply in a room of a
/// treemap.
class Overrides {
 public:
  /// uses: the calls, probes and queries of all rules. run() adds the probes and queries in the blocks of overrides.
  Overrides(CheckContext& check, Symbols& symbols, const RuleTypes& rules, Statements& statements, RuleUses& uses)
      : check_(check), symbols_(symbols), rules_(rules), statements_(statements), rule_uses_(uses) {}

  /// Checks all overrides. Must run after the check of all rules that are reachable from starts: then names in
  /// overrides are known. Materials that are first named in overrides also get the last indices, so that all other
  /// materials keep the indices that they have without overrides.
  void run();

  bool mayBeInRoom(uint32_t index) const { return in_rooms_.contains(index); }

 private:
  void checkBlocks();
  void findTags();
  void tagRooms();
  void orderPaths();
  void reportHidden();
  void assignToRules();

  CheckContext& check_;
  Symbols& symbols_;
  const RuleTypes& rules_;
  Statements& statements_;
  RuleUses& rule_uses_;
  /// the rules and layers that each override's block uses, by index into Program::overrides
  std::vector<RuleUses> uses_;
  std::set<uint32_t> in_rooms_;
};

}  // namespace sgm
