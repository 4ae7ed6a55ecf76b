// Derives combiners: unions, cuts, intersections, sums, displacements, warps.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "derive/interpret/statements.h"

namespace sgm::interpret {
namespace {

/// True for kinds of statements that add no shape to their block.
bool isSilent(StmtKind kind) {
  return kind == StmtKind::let || kind == StmtKind::field || kind == StmtKind::mat || kind == StmtKind::tag ||
         kind == StmtKind::anchor || kind == StmtKind::footprint;
}

/// Returns the radius of a smooth combiner in units; nullopt if the statement has none, or it is not positive.
std::optional<double> smoothRadius(const StmtNode& s, CellContext& c, const Env& env) {
  if (s.amount == kNoId) return std::nullopt;
  const double units = c.evaluator.real(s.amount, env) * env.place.scale * kUnitsPerMetre;
  if (!(units > 0)) return std::nullopt;
  if (units < 1e9) return units;
  c.budget.note("a smooth radius must be smaller than the world; this edge is left sharp", s.span, env.activation);
  return std::nullopt;
}

/// Converts a vector from the scope's axes to world axes, by rotation and scale. Its components may be expressions that
/// are evaluated per sample.
std::array<Num, 3> inWorld(const std::array<Num, 3>& local, const Placement& place, Draft& draft) {
  std::array<Num, 3> world;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      const Num part = draft.binary(ExprOp::multiply, {place.scale * place.axes[3 * i + j]}, local[j]);
      world[i] = draft.binary(ExprOp::add, world[i], part);
    }
  }
  return world;
}

}  // namespace

void runUnite(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  ShapeList body;
  runStatement(s.body, c, env, body);
  const std::optional<double> radius = smoothRadius(s, c, env);
  if (!radius || body.size() < 2) {
    out.insert(out.end(), body.begin(), body.end());
    return;
  }
  Shape node = shapeIn(env, ShapeKind::unite_smooth);
  node.amount = static_cast<float>(*radius);
  out.push_back(c.sink.addShape(node, s.ordinal, s.span, env, body));
}

void runCut(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  ShapeList body;
  Env inner = env;
  inner.cut_detail = 0;
  runStatement(s.body, c, inner, body);
  if (c.budget.failed() || body.empty()) return;
  c.sink.limitLevels(body, 0, 0, env.cut_detail);
  const std::optional<double> radius = smoothRadius(s, c, env);
  if (s.layer_level && env.top) {
    if (radius && body.size() > 1) {
      Shape node = shapeIn(env, ShapeKind::unite_smooth);
      node.amount = static_cast<float>(*radius);
      body = {c.sink.addShape(node, s.ordinal, s.span, env, body)};
    }
    c.sink.layerCuts().insert(c.sink.layerCuts().end(), body.begin(), body.end());
    return;
  }
  if (out.empty()) return;  // no shape precedes this cut in its block, so there is nothing to cut
  ShapeList operands{c.sink.unite(out, s, env)};
  operands.insert(operands.end(), body.begin(), body.end());
  Shape node = shapeIn(env, radius ? ShapeKind::subtract_smooth : ShapeKind::subtract);
  node.amount = static_cast<float>(radius.value_or(0));
  out = {c.sink.addShape(node, s.ordinal, s.span, env, operands)};
}

void runMeet(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const StmtNode& body = c.program.stmt(s.body);
  if (body.kind != StmtKind::block) {
    runStatement(s.body, c, env, out);
    return;
  }
  Env inner = env;
  inner.cut_detail = 0;
  label(body, inner);
  ShapeList operands;
  for (uint32_t i = 0; i < body.children.count && !c.budget.failed(); ++i) {
    const StmtNode& child = c.program.stmt(c.program.idAt(body.children, i));
    if (c.program.stmt(c.program.innermost(c.program.idAt(body.children, i))).kind == StmtKind::cut) {
      // A cut that is an operand of a meet cuts from the intersection of those operands that precede the cut.
      if (operands.size() > 1)
        operands = {c.sink.addShape(shapeIn(inner, ShapeKind::meet), child.ordinal, s.span, inner, operands)};
      runStatement(c.program.idAt(body.children, i), c, inner, operands);
      continue;
    }
    ShapeList list;
    runStatement(c.program.idAt(body.children, i), c, inner, list);
    if (isSilent(child.kind)) continue;
    if (list.empty()) {
      c.budget.note(
          "one operand of this meet is missing or was left out, so the whole meet is left out: let each give a shape",
          child.span, env.activation);
      return;
    }
    operands.push_back(c.sink.unite(list, child, inner));
  }
  if (c.budget.failed() || operands.empty()) return;
  if (operands.size() == 1) {
    out.push_back(operands[0]);
    return;
  }
  const std::optional<double> radius = smoothRadius(s, c, env);
  Shape node = shapeIn(inner, radius ? ShapeKind::meet_smooth : ShapeKind::meet);
  node.amount = static_cast<float>(radius.value_or(0));
  out.push_back(c.sink.addShape(node, s.ordinal, s.span, inner, operands));
}

void runSum(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  ShapeList body;
  runStatement(s.body, c, env, body);
  std::erase_if(body, [&](uint32_t i) {
    if (c.draft.shape(i).inner_radius > 0) return false;
    c.budget.note(
        "a sum is of shapes with an inner radius, and a half-space has none; this one is left out: cut or meet the sum "
        "with it",
        c.draft.origin(i).span, c.draft.origin(i).activation);
    return true;
  });
  if (c.budget.failed() || body.empty()) return;
  out.push_back(c.sink.addShape(shapeIn(env, ShapeKind::sum), s.ordinal, s.span, env, body));
}

void runDisplace(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  ShapeList body;
  runStatement(s.body, c, env, body);
  if (c.budget.failed() || body.empty()) return;
  const uint32_t child = c.sink.unite(body, s, env);
  Env inner = env;
  if (c.draft.sweepOf(child) != kNone) inner.sweep = c.draft.sweepOf(child);
  Num by = c.evaluator.evaluate(s.expr, inner).n[0];
  if (s.amount != kNoId) {
    const double most = std::fabs(c.evaluator.real(s.amount, env));
    by = c.draft.clamp(by, {-most}, {most});
  }
  by = c.draft.binary(ExprOp::multiply, {env.place.scale}, by);
  if (by.constant() && by.value == 0) {
    out.push_back(child);
    return;
  }
  Shape node = shapeIn(env, ShapeKind::displace);
  node.expr = c.draft.expression(by);
  out.push_back(c.sink.addShape(node, s.ordinal, s.span, env, {child}));
}

void runWarp(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  ShapeList body;
  runStatement(s.body, c, env, body);
  if (c.budget.failed() || body.empty()) return;
  const uint32_t child = c.sink.unite(body, s, env);
  Env inner = env;
  if (c.draft.sweepOf(child) != kNone) inner.sweep = c.draft.sweepOf(child);
  std::array<Num, 3> by = c.evaluator.evaluate(s.expr, inner).n;
  if (s.amount != kNoId) {
    const double most = std::fabs(c.evaluator.real(s.amount, env));
    for (Num& n : by) n = c.draft.clamp(n, {-most}, {most});
  }
  by = inWorld(by, env.place, c.draft);
  Shape node = shapeIn(env, ShapeKind::warp);
  node.expr = c.draft.triple(by);
  out.push_back(c.sink.addShape(node, s.ordinal, s.span, env, {child}));
}

}  // namespace sgm::interpret
