#pragma once
// Overrides: their blocks, the places that they replace, and the rules in which they may apply.

#include <cstdint>
#include <set>
#include <vector>

#include "grammar/check/rule_types.h"
#include "grammar/check/statements.h"

namespace sgm {

/// The rules and layers that the block of each override uses, and the overrides that may apply in a room of a treemap.
class Overrides {
 public:
  /// uses: of the rules; receives the layers that blocks ask.
  Overrides(CheckContext& check, Symbols& symbols, const RuleTypes& rules, Statements& statements, RuleUses& uses)
      : check_(check), symbols_(symbols), rules_(rules), statements_(statements), rule_uses_(uses) {}

  /// Runs after all rules reachable from starts are checked, so that the names in overrides are known, and so that
  /// materials first named in overrides come last: the other numbers are then the same as without overrides.
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
  std::vector<RuleUses> uses_;  ///< of each override
  std::set<uint32_t> in_rooms_;
};

}  // namespace sgm
