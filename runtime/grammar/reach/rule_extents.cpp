#include "grammar/reach/rule_extents.h"

namespace sgm::reach {

namespace {

void appendRange(std::vector<double>& ranges, Interval range) {
  ranges.push_back(range.lo);
  ranges.push_back(range.hi);
}

}  // namespace

RuleExtents::RuleExtents(const Program& program)
    : active_(program.rules.size(), 0), counted_(program.rules.size(), false) {
  for (uint32_t r = 0; r < program.rules.size(); ++r)
    for (const Alternative& a : program.rules[r].alternatives) counted_[r] = counted_[r] || a.depth != kNoId;
}

RuleExtents::Use RuleExtents::describe(uint32_t rule, bool top, std::span<const RangeValue> args,
                                       const RangeFrame& caller, std::vector<uint32_t> overrides) const {
  Use use;
  use.plain = {rule, top, {}, {counts_.begin(), counts_.end()}, std::move(overrides)};
  for (const RangeValue& arg : args) {
    for (const Interval& part : arg.v) appendRange(use.plain.ranges, part);
    for (const Interval& part : arg.at) appendRange(use.plain.ranges, part);
  }
  for (const Interval& edge : caller.scope) appendRange(use.plain.ranges, edge);
  use.scaled = use.plain;
  appendRange(use.scaled.ranges, caller.place.scale);
  use.placed = use.scaled;
  for (const Interval& part : caller.place.offset) appendRange(use.placed.ranges, part);
  use.placed.ranges.push_back(caller.place.turned ? 1 : 0);
  return use;
}

void RuleExtents::clear() {
  plain_.clear();
  scaled_.clear();
  placed_.clear();
}

const Extent* RuleExtents::find(const Use& use, Dependence& dependence) const {
  if (const auto known = plain_.find(use.plain); known != plain_.end()) return &known->second;
  if (const auto known = scaled_.find(use.scaled); known != scaled_.end()) {
    dependence.scale = true;
    return &known->second;
  }
  if (const auto known = placed_.find(use.placed); known != placed_.end()) {
    dependence.place = true;
    return &known->second;
  }
  return nullptr;
}

bool RuleExtents::begin(const Use& use) {
  if (!open_.insert(use.scaled).second) return false;
  const uint32_t rule = use.plain.rule;
  ++active_[rule];
  ++path_length_;
  if (counted_[rule]) ++counts_[rule];
  return true;
}

void RuleExtents::end(const Use& use, Dependence dependence, const Extent& extent) {
  const uint32_t rule = use.plain.rule;
  if (counted_[rule] && --counts_[rule] == 0) counts_.erase(rule);
  --path_length_;
  --active_[rule];
  open_.erase(use.scaled);
  if (dependence.place)
    placed_[use.placed] = extent;
  else if (dependence.scale)
    scaled_[use.scaled] = extent;
  else
    plain_[use.plain] = extent;
}

}  // namespace sgm::reach
