// Overrides: tests whether one applies to an activation of a rule or to a block with a tag, and derives its block and
// `inner`.

#include <algorithm>

#include "derive/interpret/interpreter.h"

namespace sgm {

void Interpreter::findOverrides() {
  for (const uint32_t o : program_.path_overrides) {
    const Override& edit = program_.overrides[o];
    if (edit.layer != kNoId && edit.layer != layer_index_) continue;
    if (!edit.one_cell || edit.cell == cell_) path_overrides_.push_back({o, false});
  }
}

/// True if the activation is where the first `count` steps of the path lead.
bool Interpreter::isAt(uint32_t activation, const Override& edit, uint32_t count) const {
  for (uint32_t i = count; i-- > 0; activation = activations_[activation].parent) {
    if (activation == kNone) return false;
    const Activation& use = activations_[activation];
    const PathStep& step = program_.path_steps[edit.steps.first + i];
    // The results of an override's block are edited in that block.
    if (use.edit != kNone || use.rule != step.rule) return false;
    if (step.index != kNoId && step.index != use.index) return false;
  }
  return activation == kNone;
}

/// Follows paths into an activation of a rule. Returns those that end there, as in Program::overrides.
std::vector<uint32_t> Interpreter::enterPaths(uint32_t activation) {
  Activation& use = activations_[activation];
  std::vector<PathRange> before;
  if (use.parent == kNone) {
    before.push_back({0, static_cast<uint32_t>(path_overrides_.size())});
  } else {
    before = activations_[use.parent].leads;
    use.steps = activations_[use.parent].steps;
  }
  const auto stepsOf = [&](const PathOverride& o) { return program_.overrides[o.index].steps; };
  const auto stepOf = [&](const PathOverride& o) { return program_.path_steps[stepsOf(o).first + use.steps]; };
  std::vector<uint32_t> found;
  const auto enter = [&](const PathRange& range, const PathStep& step) {
    const auto begin = path_overrides_.begin();
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

std::vector<uint32_t> Interpreter::overridesOf(uint16_t tag, const Env& env) const {
  std::vector<uint32_t> found;
  const IdRange all = program_.overridesOf(tag);
  for (uint32_t i = 0; i < all.count; ++i) {
    const uint32_t o = program_.idAt(all, i);
    const OwnBlock* within = env.within;
    while (within != nullptr && within->edit != o) within = within->outer;
    if (within == nullptr) found.push_back(o);
  }
  return found;
}

void Interpreter::use(const UnderEdit& what, size_t below, Env& env, ShapeList& out) {
  if (below > 0) {
    overridden(what, below - 1, env, out);
  } else if (what.statement != nullptr) {
    what.room ? contents(*what.statement, env, out) : untagged(*what.statement, env, out);
  } else {
    alternatives(*what.rule, env, *what.arguments, out);
  }
}

void Interpreter::overridden(const UnderEdit& what, size_t at, const Env& env, ShapeList& out) {
  const uint32_t index = what.edits[at];
  const Override& edit = program_.overrides[index];
  if (!step(1 + edit.slot_count, edit.span, env.activation)) return;
  std::vector<Value> slots;
  if (what.arguments != nullptr) slots = *what.arguments;
  slots.resize(std::max<size_t>(edit.slot_count, slots.size()));
  Activation activation;
  activation.rule = activations_[env.activation].rule;
  activation.edit = index;
  activation.parent = env.activation;
  activation.start = activations_[env.activation].start;
  const OwnBlock own_block{index, env.within};
  Env own = env;
  own.key = env.key.child(edit.hash, what.statement != nullptr ? what.statement->ordinal : 0);
  own.activation = static_cast<uint32_t>(activations_.size());
  own.slots = &slots;
  own.written_material = own.written_tag = 0;
  if (edit.by_tag) own.within = &own_block;
  const UnderEdit inside{what.rule, what.arguments, what.statement, what.edits, at, &env, own.key, what.room};
  own.under = &inside;
  activations_.push_back(std::move(activation));
  const size_t first = out.size();
  what.room ? contents(program_.stmt(edit.body), own, out) : statement(edit.body, own, out);
  // A morphic rule must produce one node.
  if (what.rule == nullptr || !what.rule->morphic || out.size() <= first + 1 || failed()) return;
  const ShapeList parts(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
  out.resize(first);
  out.push_back(united(parts, program_.stmt(edit.body), own));
}

void Interpreter::inner(const StmtNode& s, const Env& env, ShapeList& out) {
  if (env.under == nullptr) return;
  const UnderEdit& what = *env.under;
  // With the position, labels and levels of this statement; everything else as without the override.
  Env below = env;
  below.activation = what.env->activation;
  below.slots = what.env->slots;
  below.under = what.env->under;
  below.within = what.env->within;
  below.top = env.top && s.layer_level;
  // The first copy keeps its key, so that it is identical to the byte; further copies have keys of their own.
  below.key = env.key == what.own_key && s.extra == 0 ? what.env->key : env.key.child(what.env->key.value, s.ordinal);
  if (env.forced_material == 0) below.forced_material = env.written_material;
  if (env.forced_tag == 0) below.forced_tag = env.written_tag;
  below.written_material = below.written_tag = 0;
  if (what.rule == nullptr) return use(what, what.at, below, out);
  const Placement start = activations_[below.activation].start;
  activations_[below.activation].start = env.place;
  use(what, what.at, below, out);
  activations_[below.activation].start = start;
}

/// Derives a block, or the meet or extrusion that has the block, under the overrides of its tag.
void Interpreter::tagged(const StmtNode& s, uint16_t tag, const Env& env, ShapeList& out, bool room) {
  Env inner = env;
  const std::vector<uint32_t> edits = overridesOf(tag, env);
  if (!step(edits.size(), s.span, env.activation)) return;
  use({nullptr, nullptr, &s, edits, edits.size(), nullptr, {}, room}, edits.size(), inner, out);
}

void Interpreter::untagged(const StmtNode& s, const Env& env, ShapeList& out) {
  if (s.kind == StmtKind::meet) return meet(s, env, out);
  if (s.kind == StmtKind::extrude) return extrude(s, env, out);
  block(s, env, out);
}

/// If the path of an override leads nowhere in the only cell that it names, notes how far it does lead.
void Interpreter::noteMissed() {
  for (const PathOverride& o : path_overrides_) {
    const Override& edit = program_.overrides[o.index];
    if (o.found || !(edit.one_cell || isWhole(layer_))) continue;
    if (notes_.size() >= limits_.notes) {
      ++dropped_notes_;
      continue;
    }
    // The longest prefix of the path that exists: at least the start.
    uint32_t known = edit.steps.count, last = kNone;
    while (last == kNone && known > 1) {
      --known;
      for (uint32_t a = 0; a < activations_.size() && last == kNone; ++a)
        if (isAt(a, edit, known)) last = a;
    }
    if (last == kNone) continue;
    const PathStep& step = program_.path_steps[edit.steps.first + known];
    // Among several places with that prefix, the one with the most uses.
    std::vector<uint32_t> uses(activations_.size(), 0);
    uint32_t count = 0;
    for (const Activation& a : activations_)
      if (a.rule == step.rule && a.edit == kNone && a.parent != kNone && isAt(a.parent, edit, known))
        count = std::max(count, ++uses[a.parent]);
    const std::string name(program_.text(program_.rules[step.rule].name));
    const std::string found = count == 0 ? "is no" : count == 1 ? "is only one" : "are only " + std::to_string(count);
    note("this override finds nothing: there " + found + " `" + name + "` here", edit.address_span, last);
  }
}

}  // namespace sgm
