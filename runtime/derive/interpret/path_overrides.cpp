#include "derive/interpret/path_overrides.h"

#include <algorithm>
#include <string>

namespace sgm::interpret {

PathOverrides::PathOverrides(const CellInputs& in, Activations& activations) : in_(in), activations_(activations) {
  for (const uint32_t o : in.program.path_overrides) {
    const Override& edit = in.program.overrides[o];
    if (edit.layer != kNoId && edit.layer != in.layer_index) continue;
    if (!edit.one_cell || edit.cell == in.cell) all_.push_back({o, false});
  }
}

bool PathOverrides::isAt(uint32_t activation, const Override& edit, uint32_t count) const {
  for (uint32_t i = count; i-- > 0; activation = activations_[activation].parent) {
    if (activation == kNone) return false;
    const Activation& use = activations_[activation];
    const PathStep& step = in_.program.path_steps[edit.steps.first + i];
    // A path cannot lead into the block of an override: the block itself can be edited instead.
    if (use.edit != kNone || use.rule != step.rule) return false;
    if (step.index != kNoId && step.index != use.index) return false;
  }
  return activation == kNone;
}

std::vector<uint32_t> PathOverrides::enter(uint32_t activation) {
  Activation& use = activations_[activation];
  std::vector<PathRange> before;
  if (use.parent == kNone) {
    before.push_back({0, static_cast<uint32_t>(all_.size())});
  } else {
    before = activations_[use.parent].leads;
    use.steps = activations_[use.parent].steps;
  }
  const auto stepsOf = [&](const PathOverride& o) { return in_.program.overrides[o.index].steps; };
  const auto stepOf = [&](const PathOverride& o) { return in_.program.path_steps[stepsOf(o).first + use.steps]; };
  std::vector<uint32_t> found;
  const auto enter = [&](const PathRange& range, const PathStep& step) {
    const auto begin = all_.begin();
    const auto last = begin + range.end;
    auto first = std::ranges::lower_bound(begin + range.first, last, step, {}, stepOf);
    const auto end = std::ranges::upper_bound(first, last, step, {}, stepOf);
    for (; first != end && stepsOf(*first).count == use.steps + 1; ++first) {
      first->found = true;
      found.push_back(first->index);
    }
    if (first != end) use.leads.push_back({static_cast<uint32_t>(first - begin), static_cast<uint32_t>(end - begin)});
  };
  for (const PathRange& range : before) {
    if (range.first == range.end) continue;
    enter(range, {use.rule, use.index});
    enter(range, {use.rule, kNoId});
  }
  ++use.steps;
  std::sort(found.begin(), found.end());
  return found;
}

void PathOverrides::noteMissed(Budget& budget) const {
  for (const PathOverride& o : all_) {
    const Override& edit = in_.program.overrides[o.index];
    if (o.found || !(edit.one_cell || isWhole(in_.layer))) continue;
    if (budget.isFullOfNotes()) {
      budget.dropNote();
      continue;
    }
    // Find the longest prefix of the path that exists in the cell. The first step, the start rule, always exists.
    uint32_t known = edit.steps.count, last = kNone;
    while (last == kNone && known > 1) {
      --known;
      for (uint32_t a = 0; a < activations_.count() && last == kNone; ++a)
        if (isAt(a, edit, known)) last = a;
    }
    if (last == kNone) continue;
    const PathStep& step = in_.program.path_steps[edit.steps.first + known];
    // If several activations match the prefix, report the activation that uses the next rule of the path most often.
    std::vector<uint32_t> uses(activations_.count(), 0);
    uint32_t count = 0;
    for (uint32_t i = 0; i < activations_.count(); ++i) {
      const Activation& a = activations_[i];
      if (a.rule == step.rule && a.edit == kNone && a.parent != kNone && isAt(a.parent, edit, known))
        count = std::max(count, ++uses[a.parent]);
    }
    const std::string name(in_.program.text(in_.program.rules[step.rule].name));
    const std::string found = count == 0 ? "is no" : count == 1 ? "is only one" : "are only " + std::to_string(count);
    budget.note("this override finds nothing: there " + found + " `" + name + "` here", edit.address_span, last);
  }
}

}  // namespace sgm::interpret
