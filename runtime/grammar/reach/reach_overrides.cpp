// Overrides in the proof of reach: where they may apply, and the content of their blocks.

#include <algorithm>

#include "grammar/reach/reach_check.h"

namespace sgm {

namespace {

std::vector<uint32_t> listOf(const Program& program, IdRange range) {
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < range.count; ++i) out.push_back(program.idAt(range, i));
  return out;
}

/// Whether both may apply to one use. Precondition: their steps are uses of the same rules.
bool together(const Program& program, const Override& a, const Override& b) {
  if (a.one_cell && b.one_cell && (a.layer != b.layer || a.cell != b.cell)) return false;
  for (uint32_t i = 0; i < a.steps.count; ++i) {
    const uint32_t left = program.path_steps[a.steps.first + i].index;
    const uint32_t right = program.path_steps[b.steps.first + i].index;
    if (left != right && left != kNoId && right != kNoId) return false;
  }
  return true;
}

/// Whether `wide` applies wherever `narrow` (null: any path with these rules) does.
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

void ReachCheck::startOverrides(uint32_t layer) {
  edits_ = {};
  under_ = nullptr;
  for (uint32_t o = 0; o < program_.overrides.size(); ++o) {
    const Override& edit = program_.overrides[o];
    if (!edit.by_tag && (edit.layer == kNoId || edit.layer == layer)) edits_.begun.push_back(o);
  }
}

/// Updates the state of overrides for a use of the rule: the paths that continue, and those that end here.
std::vector<uint32_t> ReachCheck::enter(uint32_t rule) {
  std::vector<uint32_t> ended;
  std::erase_if(edits_.begun, [&](uint32_t o) {
    const IdRange steps = program_.overrides[o].steps;
    if (program_.path_steps[steps.first + edits_.depth].rule != rule) return true;
    if (steps.count > edits_.depth + 1) return false;
    ended.push_back(o);
    return true;
  });
  edits_.depth = edits_.begun.empty() ? 0 : edits_.depth + 1;
  return ended;
}

/// The part of the key that separates uses with the same arguments.
std::vector<uint32_t> ReachCheck::editKey(const std::vector<uint32_t>& ended) const {
  if (program_.overrides.empty()) return {};
  std::vector<uint32_t> key = ended;
  key.push_back(kNoId);
  key.insert(key.end(), edits_.begun.begin(), edits_.begun.end());
  key.push_back(kNoId);
  key.push_back(edits_.depth);
  key.insert(key.end(), edits_.within.begin(), edits_.within.end());
  return key;
}

Extent ReachCheck::use(const UnderEdit& what, size_t below, RangeFrame& frame, const Override* above) {
  Extent out = Extent::nothing();
  bool first = true;
  // If both extend equally far, blame the content without the override.
  const auto also = [&](Extent part) {
    if (!first) part.either(out);
    out = part;
    first = false;
  };
  for (size_t i = below; i-- > 0;) {
    const Override& edit = program_.overrides[what.edits[i]];
    if (above != nullptr && !edit.by_tag && !together(program_, *above, edit)) continue;
    also(overridden(what, i, frame));
    if (tooFar()) return Extent::unbounded();
    if (edit.by_tag || covers(program_, edit, above)) return out;
  }
  also(what.block != nullptr ? untagged(*what.block, frame) : alternatives(what.rule, what.args, frame, frame.top));
  return out;
}

/// The extent of an override's block in place of a use or of a block.
Extent ReachCheck::overridden(const UnderEdit& what, size_t at, const RangeFrame& place) {
  const Override& edit = program_.overrides[what.edits[at]];
  RangeFrame frame;
  frame.scope = place.scope;
  frame.place = place.place;
  frame.start = what.block != nullptr ? place.start : place.place;
  frame.top = place.top;
  frame.slots = what.args;
  frame.slots.resize(std::max<size_t>(edit.slot_count, what.args.size()));
  const UnderEdit inside{what.rule, what.args, what.edits, what.block, what.frame, at, edits_, under_};
  const UnderEdit* const outer = under_;
  const EditState before = edits_;
  under_ = &inside;
  edits_.begun.clear();
  edits_.depth = 0;
  if (edit.by_tag) edits_.within.push_back(what.edits[at]);
  Extent out = statement(edit.body, frame);
  out.override_id = what.edits[at];
  if (!out.empty) out.contributor_size = std::max(out.contributor_size, out.size());
  edits_ = before;
  under_ = outer;
  return out;
}

Extent ReachCheck::inner(const StmtNode& s, const RangeFrame& at) {
  const UnderEdit& what = *under_;
  const EditState before = edits_;
  edits_ = what.state;
  under_ = what.outer;
  RangeFrame frame = at;
  frame.top = at.top && s.layer_level;
  if (what.block != nullptr) {
    frame.slots = what.frame->slots;
    frame.start = what.frame->start;
  }
  const Override* above = &program_.overrides[what.edits[what.at]];
  const Extent out = use(what, what.at, frame, above->by_tag ? nullptr : above);
  edits_ = before;
  under_ = &what;
  return out;
}

/// The extent of a block, a meet or an extrusion with the overrides of its tag.
Extent ReachCheck::tagged(const StmtNode& s, uint16_t tag, RangeFrame& frame) {
  std::vector<uint32_t> edits = listOf(program_, program_.overridesOf(tag));
  std::erase_if(edits, [&](uint32_t o) {
    return std::find(edits_.within.begin(), edits_.within.end(), o) != edits_.within.end();
  });
  if (edits.empty()) return untagged(s, frame);
  const UnderEdit what{0, {}, edits, &s, &frame, edits.size(), edits_, under_};
  return use(what, edits.size(), frame, nullptr);
}

Extent ReachCheck::untagged(const StmtNode& s, RangeFrame& frame) {
  if (s.kind == StmtKind::extrude) return extrude(s, frame);
  return s.kind == StmtKind::meet ? meet(s, frame) : block(s, frame);
}

}  // namespace sgm
