// Dispatches statements to the functions of their kinds, and derives blocks.

#include "derive/interpret/statements.h"

#include <algorithm>

#include "derive/interpret/leaves.h"
#include "derive/interpret/overrides.h"

namespace sgm::interpret {
namespace {

bool blends(const StmtNode& s) {
  return (s.kind == StmtKind::unite && s.amount != kNoId) || s.kind == StmtKind::meet || s.kind == StmtKind::sum ||
         s.kind == StmtKind::morph || s.kind == StmtKind::displace || s.kind == StmtKind::warp;
}

}  // namespace

void runStatement(StmtId id, CellContext& c, const Env& env, ShapeList& out) {
  if (c.budget.failed() || id == kNoId) return;
  const StmtNode& s = c.program.stmt(id);
  if (c.coarse_edge > 0 && !env.whole && blends(s)) {
    Env whole = env;
    whole.whole = true;
    runStatement(id, c, whole, out);
    return;
  }
  if (!c.budget.step(1, s.span, env.activation)) return;
  const Nested nested = c.budget.nest();
  if (!c.budget.withinNesting(s.span, env.activation)) return;
  switch (s.kind) {
    case StmtKind::block:
      if (c.program.overridesOf(s.tag).count > 0)
        runTagged(s, s.tag, c, env, out);
      else
        runBlock(s, c, env, out);
      break;
    case StmtKind::call:
      runCall(s.expr, s.ordinal, c, env, out);
      break;
    case StmtKind::unite:
      runUnite(s, c, env, out);
      break;
    case StmtKind::cut:
      runCut(s, c, env, out);
      break;
    case StmtKind::meet:
      if (const uint16_t tag = c.program.stmt(s.body).tag; c.program.overridesOf(tag).count > 0)
        runTagged(s, tag, c, env, out);
      else
        runMeet(s, c, env, out);
      break;
    case StmtKind::sum:
      runSum(s, c, env, out);
      break;
    case StmtKind::morph:
      runMorph(s, c, env, out);
      break;
    case StmtKind::displace:
      runDisplace(s, c, env, out);
      break;
    case StmtKind::warp:
      runWarp(s, c, env, out);
      break;
    case StmtKind::transform:
      runTransform(s, c, env, out);
      break;
    case StmtKind::repeat:
      runRepeat(s, c, env, out);
      break;
    case StmtKind::for_each:
      runForEach(s, c, env, out);
      break;
    case StmtKind::scatter:
      runScatter(s, c, env, out);
      break;
    case StmtKind::split:
      runSplit(s, c, env, out);
      break;
    case StmtKind::snap:
      runSnap(s, c, env, out);
      break;
    case StmtKind::comp:
      runComp(s, c, env, out);
      break;
    case StmtKind::treemap:
      runTreemap(s, c, env, out);
      break;
    case StmtKind::wfc:
      runWfc(s, c, env, out);
      break;
    case StmtKind::footprint:
      runFootprint(s, c, env);
      break;
    case StmtKind::extrude:
      if (const uint16_t tag = s.body == kNoId ? uint16_t{0} : c.program.stmt(s.body).tag;
          c.program.overridesOf(tag).count > 0)
        runTagged(s, tag, c, env, out);
      else
        runExtrude(s, c, env, out);
      break;
    case StmtKind::roof:
      runRoof(s, c, env, out);
      break;
    case StmtKind::fit:
      runFit(s, c, env, out);
      break;
    case StmtKind::let:
      if (env.slots != nullptr && s.slot < env.slots->size()) (*env.slots)[s.slot] = c.evaluator.evaluate(s.expr, env);
      break;
    case StmtKind::anchor:
      runAnchor(s, c, env);
      break;
    case StmtKind::detail:
      runDetail(s, c, env, out);
      break;
    case StmtKind::inner:
      runInner(s, c, env, out);
      break;
    case StmtKind::field:  // Nothing to do here: the value is evaluated where its name is used.
    // Nothing to do here: the checker has already stored the material or tag in the enclosing block.
    case StmtKind::mat:
    case StmtKind::tag:
    case StmtKind::link:  // Nothing to do here: the enclosing treemap evaluates its links.
    case StmtKind::border:
      break;
  }
}

void runCall(ExprId id, uint32_t ordinal, CellContext& c, const Env& env, ShapeList& out) {
  if (c.budget.failed() || id == kNoId) return;
  const ExprNode& node = c.program.expr(id);
  if (!c.budget.step(1, node.span, env.activation)) return;
  if (node.ref == Ref::rule) {
    c.rules.call(node.id, node, ordinal, env, out);
  } else if (node.ref == Ref::primitive) {
    addPrimitive(static_cast<Primitive>(node.id), node, ordinal, c, env, out);
  }
}

void label(const StmtNode& block, Env& env) {
  if (block.material != 0) env.written_material = block.material;
  if (block.tag != 0) env.written_tag = block.tag;
  if (block.material != 0 && env.forced_material == 0) env.material = block.material;
  if (block.tag != 0 && env.forced_tag == 0) env.tag = block.tag;
}

void runBlock(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  ShapeList own;
  runContents(s, c, env, own);
  out.insert(out.end(), own.begin(), own.end());
}

void runContents(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  Env inner = env;
  inner.cut_detail = 0;
  label(s, inner);
  for (uint32_t i = 0; i < s.children.count; ++i) runStatement(c.program.idAt(s.children, i), c, inner, out);
}

void runDetail(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const int32_t edge = std::max(1, toUnits(c.evaluator.real(s.expr, env)));
  if (c.skips(edge, env)) return;
  const StmtNode& inside = c.program.stmt(c.program.innermost(s.body));
  if (inside.kind == StmtKind::cut && !(inside.layer_level && env.top)) {
    Env inner = env;
    inner.cut_detail = env.cut_detail > 0 ? std::min(env.cut_detail, edge) : edge;
    runStatement(s.body, c, inner, out);
    return;
  }
  ShapeList body;
  const size_t first_cut = c.sink.layerCuts().size();
  runStatement(s.body, c, env, body);
  c.sink.limitLevels(body, 0, 0, edge);
  c.sink.limitLevels(c.sink.layerCuts(), first_cut, 0, edge);
  out.insert(out.end(), body.begin(), body.end());
}

}  // namespace sgm::interpret
