#include "grammar/reach/override_extents.h"

#include <algorithm>

#include "grammar/reach/reach_context.h"
#include "grammar/reach/reach_rules.h"
#include "grammar/reach/reach_statements.h"

namespace sgm::reach {

namespace {

std::vector<uint32_t> listIds(const Program& program, IdRange range) {
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < range.count; ++i) out.push_back(program.idAt(range, i));
  return out;
}

/// Whether both overrides may apply to the same use of a rule (a place at which derivation applies the rule).
/// Precondition: the paths of both name the same rules in their steps.
bool canApplyTogether(const Program& program, const Override& a, const Override& b) {
  if (a.one_cell && b.one_cell && (a.layer != b.layer || a.cell != b.cell)) return false;
  for (uint32_t i = 0; i < a.steps.count; ++i) {
    const uint32_t left = program.path_steps[a.steps.first + i].index;
    const uint32_t right = program.path_steps[b.steps.first + i].index;
    if (left != right && left != kNoId && right != kNoId) return false;
  }
  return true;
}

/// Whether `wide` applies to every use of a rule (a place at which derivation applies it) to which `narrow` applies. If
/// narrow is null: whether `wide` applies to every use that a path through its rules can reach.
bool covers(const Program& program, const Override& wide, const Override* narrow) {
  if (wide.one_cell && (narrow == nullptr || !narrow->one_cell || narrow->cell != wide.cell)) return false;
  for (uint32_t i = 0; i < wide.steps.count; ++i) {
    const uint32_t index = program.path_steps[wide.steps.first + i].index;
    if (index == kNoId) continue;
    if (narrow == nullptr || program.path_steps[narrow->steps.first + i].index != index) return false;
  }
  return true;
}

}  // namespace

void OverrideExtents::start(uint32_t layer) {
  state_ = {};
  target_ = nullptr;
  for (uint32_t o = 0; o < program_.overrides.size(); ++o) {
    const Override& candidate = program_.overrides[o];
    if (!candidate.by_tag && (candidate.layer == kNoId || candidate.layer == layer)) state_.begun.push_back(o);
  }
}

std::vector<uint32_t> OverrideExtents::enter(uint32_t rule) {
  std::vector<uint32_t> replacing;
  std::erase_if(state_.begun, [&](uint32_t o) {
    const IdRange steps = program_.overrides[o].steps;
    if (program_.path_steps[steps.first + state_.depth].rule != rule) return true;
    if (steps.count > state_.depth + 1) return false;
    replacing.push_back(o);
    return true;
  });
  state_.depth = state_.begun.empty() ? 0 : state_.depth + 1;
  return replacing;
}

std::vector<uint32_t> OverrideExtents::key(const std::vector<uint32_t>& replacing) const {
  if (program_.overrides.empty()) return {};
  std::vector<uint32_t> key = replacing;
  key.push_back(kNoId);
  key.insert(key.end(), state_.begun.begin(), state_.begun.end());
  key.push_back(kNoId);
  key.push_back(state_.depth);
  key.insert(key.end(), state_.within.begin(), state_.within.end());
  return key;
}

Extent OverrideExtents::boundUse(uint32_t rule, const std::vector<RangeValue>& args,
                                 const std::vector<uint32_t>& replacing, RangeFrame& frame, ReachContext& context) {
  return boundTarget({rule, args, replacing, nullptr, nullptr, 0, state_, nullptr}, replacing.size(), frame, nullptr,
                     context);
}

Extent OverrideExtents::boundTagged(const StmtNode& s, uint16_t tag, RangeFrame& frame, ReachContext& context) {
  std::vector<uint32_t> overrides = listIds(program_, program_.overridesOf(tag));
  std::erase_if(overrides, [&](uint32_t o) {
    return std::find(state_.within.begin(), state_.within.end(), o) != state_.within.end();
  });
  if (overrides.empty()) return boundUntagged(s, frame, context);
  const std::vector<RangeValue> no_args;
  const Target target{0, no_args, overrides, &s, &frame, overrides.size(), state_, target_};
  return boundTarget(target, overrides.size(), frame, nullptr, context);
}

Extent OverrideExtents::boundInner(const StmtNode& s, const RangeFrame& at, ReachContext& context) {
  const Target& target = *target_;
  const State before = state_;
  state_ = target.state;
  target_ = target.outer;
  RangeFrame frame = at;
  frame.top = at.top && s.layer_level;
  if (target.block != nullptr) {
    frame.slots = target.frame->slots;
    frame.start = target.frame->start;
  }
  const Override* above = &program_.overrides[target.overrides[target.at]];
  const Extent out = boundTarget(target, target.at, frame, above->by_tag ? nullptr : above, context);
  state_ = before;
  target_ = &target;
  return out;
}

Extent OverrideExtents::boundTarget(const Target& target, size_t below, RangeFrame& frame, const Override* above,
                                    ReachContext& context) {
  std::optional<Extent> out;
  // If the extents with and without an override are equally large, messages name the content without the override as
  // the largest contributor.
  const auto add = [&](Extent part) {
    if (out) part.either(*out);
    out = std::move(part);
  };
  for (size_t i = below; i-- > 0;) {
    const Override& candidate = program_.overrides[target.overrides[i]];
    if (above != nullptr && !candidate.by_tag && !canApplyTogether(program_, *above, candidate)) continue;
    add(boundReplacement(target, i, frame, context));
    if (context.budget.cutAtLimit()) return Extent::unbounded();
    if (candidate.by_tag || covers(program_, candidate, above)) return *out;
  }
  add(target.block != nullptr ? boundUntagged(*target.block, frame, context)
                              : boundAlternatives(target.rule, target.args, frame, context));
  return *out;
}

Extent OverrideExtents::boundReplacement(const Target& target, size_t at, const RangeFrame& place,
                                         ReachContext& context) {
  const uint32_t id = target.overrides[at];
  const Override& applied = program_.overrides[id];
  RangeFrame frame;
  frame.scope = place.scope;
  frame.place = place.place;
  frame.start = target.block != nullptr ? place.start : place.place;
  frame.top = place.top;
  frame.slots = target.args;
  frame.slots.resize(std::max<size_t>(applied.slot_count, target.args.size()));
  const Target inside{target.rule, target.args, target.overrides, target.block, target.frame, at, state_, target_};
  const Target* const outer = target_;
  const State before = state_;
  target_ = &inside;
  state_.begun.clear();
  state_.depth = 0;
  if (applied.by_tag) state_.within.push_back(id);
  Extent out = boundStatement(applied.body, frame, context);
  out.override_id = id;
  if (!out.empty) out.contributor_size = std::max(out.contributor_size, out.size());
  state_ = before;
  target_ = outer;
  return out;
}

}  // namespace sgm::reach
