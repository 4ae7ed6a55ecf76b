#pragma once
// Determines the order in which rules are checked: types flow from callers to callees.

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "grammar/syntax/units.h"

namespace sgm {

/// Stores the types of each rule's parameters, as inferred from the calls checked so far, and a queue of rules to
/// check.
class RuleTypes {
 public:
  explicit RuleTypes(size_t rules) : types_(rules), states_(rules, State::unreached) {}

  /// Whether the rule itself, or a call of it, was checked.
  bool isReached(uint32_t rule) const { return states_[rule] != State::unreached; }
  /// Whether the rule was checked and is not queued to be checked again.
  bool isChecked(uint32_t rule) const { return states_[rule] == State::checked; }
  const std::vector<Type>& of(uint32_t rule) const { return types_[rule]; }

  /// Sets the parameter types of a rule that is checked although no call uses it.
  void assume(uint32_t rule, std::vector<Type> types);
  /// Sets the parameter types that the first call passes, and queues the rule.
  void reach(uint32_t rule, std::vector<Type> types);
  /// Replaces the type of one parameter that was unknown so far; queues the rule again if it was already checked.
  void refine(uint32_t rule, size_t parameter, const Type& type);

  /// Removes and returns the next queued rule, in the order of first calls; nullopt if the queue is empty.
  std::optional<uint32_t> takeWaiting();
  /// Marks a rule as checked. Returns whether this is its first check.
  bool beginCheck(uint32_t rule);

 private:
  enum class State : uint8_t { unreached, waiting, checked };

  std::vector<std::vector<Type>> types_;
  std::vector<State> states_;
  std::vector<uint32_t> waiting_;
  size_t next_waiting_ = 0;
  std::set<uint32_t> begun_;  ///< rules whose check has begun at least once
};

}  // namespace sgm
