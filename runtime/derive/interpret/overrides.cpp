#include "derive/interpret/overrides.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "derive/interpret/statements.h"

namespace sgm::interpret {
namespace {

/// Returns the overrides of a tag, except those whose own block contains the statement.
std::vector<uint32_t> overridesOf(uint16_t tag, const Program& program, const Env& env) {
  std::vector<uint32_t> found;
  const IdRange all = program.overridesOf(tag);
  for (uint32_t i = 0; i < all.count; ++i) {
    const uint32_t o = program.idAt(all, i);
    const OwnBlock* within = env.within;
    while (within != nullptr && within->edit != o) within = within->outer;
    if (within == nullptr) found.push_back(o);
  }
  return found;
}

/// Derives the block of the override with index what.edits[at].
void runEdit(const UnderEdit& what, size_t at, CellContext& c, const Env& env, ShapeList& out) {
  const uint32_t index = what.edits[at];
  const Override& edit = c.program.overrides[index];
  if (!c.budget.step(1 + edit.slot_count, edit.span, env.activation)) return;
  std::vector<Value> slots;
  if (what.arguments != nullptr) slots = *what.arguments;
  slots.resize(std::max<size_t>(edit.slot_count, slots.size()));
  Activation activation;
  activation.rule = c.activations[env.activation].rule;
  activation.edit = index;
  activation.parent = env.activation;
  activation.start = c.activations[env.activation].start;
  const OwnBlock own_block{index, env.within};
  Env own = env;
  own.key = env.key.child(edit.hash, what.statement != nullptr ? what.statement->ordinal : 0);
  own.activation = c.activations.add(std::move(activation));
  own.slots = &slots;
  own.written_material = own.written_tag = 0;
  if (edit.by_tag) own.within = &own_block;
  const UnderEdit inside{what.rule, what.arguments, what.statement, what.edits, at, &env, own.key, what.room};
  own.under = &inside;
  const size_t first = out.size();
  what.room ? runContents(c.program.stmt(edit.body), c, own, out) : runStatement(edit.body, c, own, out);
  // A morphic rule must produce exactly one shape, so several shapes are united.
  if (what.rule == nullptr || !what.rule->morphic || out.size() <= first + 1 || c.budget.failed()) return;
  const ShapeList parts(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
  out.resize(first);
  out.push_back(c.sink.unite(parts, c.program.stmt(edit.body), own));
}

void runUntagged(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  if (s.kind == StmtKind::meet) return runMeet(s, c, env, out);
  if (s.kind == StmtKind::extrude) return runExtrude(s, c, env, out);
  runBlock(s, c, env, out);
}

}  // namespace

void runUnderEdits(const UnderEdit& what, size_t below, CellContext& c, Env& env, ShapeList& out) {
  if (below > 0) {
    runEdit(what, below - 1, c, env, out);
  } else if (what.statement != nullptr) {
    what.room ? runContents(*what.statement, c, env, out) : runUntagged(*what.statement, c, env, out);
  } else {
    c.rules.runAlternatives(*what.rule, env, *what.arguments, out);
  }
}

void runInner(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  if (env.under == nullptr) return;
  const UnderEdit& what = *env.under;
  // Derives the replaced content as if there were no override. However, its position, labels and levels are those of
  // this `inner` statement.
  Env below = env;
  below.activation = what.env->activation;
  below.slots = what.env->slots;
  below.under = what.env->under;
  below.within = what.env->within;
  below.top = env.top && s.layer_level;
  // The first `inner` in an override keeps the key of the replaced content, so that it derives bitwise identical
  // content; further `inner` statements get keys of their own.
  below.key = env.key == what.own_key && s.extra == 0 ? what.env->key : env.key.child(what.env->key.value, s.ordinal);
  if (env.forced_material == 0) below.forced_material = env.written_material;
  if (env.forced_tag == 0) below.forced_tag = env.written_tag;
  below.written_material = below.written_tag = 0;
  if (what.rule == nullptr) return runUnderEdits(what, what.at, c, below, out);
  const Placement start = c.activations[below.activation].start;
  c.activations[below.activation].start = env.place;
  runUnderEdits(what, what.at, c, below, out);
  c.activations[below.activation].start = start;
}

void runTagged(const StmtNode& s, uint16_t tag, CellContext& c, const Env& env, ShapeList& out, bool room) {
  Env inner = env;
  const std::vector<uint32_t> edits = overridesOf(tag, c.program, env);
  if (!c.budget.step(edits.size(), s.span, env.activation)) return;
  runUnderEdits({nullptr, nullptr, &s, edits, edits.size(), nullptr, {}, room}, edits.size(), c, inner, out);
}

}  // namespace sgm::interpret
