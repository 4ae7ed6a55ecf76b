#pragma once
// The order in which rules are checked: types flow from callers to callees.

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "grammar/syntax/units.h"

namespace sgm {

/// The types of each rule's parameters, as far as its calls have shown them, and the rules that wait for their check.
class RuleTypes {
 public:
  explicit RuleTypes(size_t rules) : types_(rules), states_(rules, State::unreached) {}

  /// Whether a call of the rule was checked, or the rule itself.
  bool isReached(uint32_t rule) const { return states_[rule] != State::unreached; }
  /// Whether the rule was checked, and does not wait for another check.
  bool isChecked(uint32_t rule) const { return states_[rule] == State::checked; }
  const std::vector<Type>& of(uint32_t rule) const { return types_[rule]; }

  /// Sets the types of a rule that nothing calls.
  void assume(uint32_t rule, std::vector<Type> types);
  /// Sets the types that the first call gives; the rule then waits.
  void reach(uint32_t rule, std::vector<Type> types);
  /// Replaces the type of one parameter, which was open before; a checked rule then waits for another check.
  void refine(uint32_t rule, size_t parameter, const Type& type);

  /// The next rule in the order of the first calls; nullopt if none waits.
  std::optional<uint32_t> takeWaiting();
  /// Marks a rule as checked, and returns whether it is for the first time.
  bool beginCheck(uint32_t rule);

 private:
  enum class State : uint8_t { unreached, waiting, checked };

  std::vector<std::vector<Type>> types_;
  std::vector<State> states_;
  std::vector<uint32_t> waiting_;
  size_t next_waiting_ = 0;
  std::set<uint32_t> begun_;  ///< rules that were checked at least once
};

}  // namespace sgm
