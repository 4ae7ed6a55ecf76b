#include "grammar/check/rule_types.h"

#include <utility>

namespace sgm {

void RuleTypes::assume(uint32_t rule, std::vector<Type> types) { types_[rule] = std::move(types); }

void RuleTypes::reach(uint32_t rule, std::vector<Type> types) {
  states_[rule] = State::waiting;
  types_[rule] = std::move(types);
  waiting_.push_back(rule);
}

void RuleTypes::refine(uint32_t rule, size_t parameter, const Type& type) {
  Type& known = types_[rule][parameter];
  if (known == type) return;
  known = type;
  if (states_[rule] != State::checked) return;
  states_[rule] = State::waiting;
  waiting_.push_back(rule);
}

std::optional<uint32_t> RuleTypes::takeWaiting() {
  if (next_waiting_ == waiting_.size()) return std::nullopt;
  return waiting_[next_waiting_++];
}

bool RuleTypes::beginCheck(uint32_t rule) {
  states_[rule] = State::checked;
  return begun_.insert(rule).second;
}

}  // namespace sgm
