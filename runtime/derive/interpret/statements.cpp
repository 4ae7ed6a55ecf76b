// Blocks and combiners.

#include <algorithm>
#include <cmath>

#include "derive/draws.h"
#include "derive/interpret/interpreter.h"

namespace sgm {
namespace {

/// Statements that add no shape to their block.
bool isSilent(StmtKind kind) {
  return kind == StmtKind::let || kind == StmtKind::field || kind == StmtKind::mat || kind == StmtKind::tag ||
         kind == StmtKind::anchor || kind == StmtKind::footprint;
}

}  // namespace

Shape Interpreter::shapeIn(const Env& env, ShapeKind kind) const {
  Shape s;
  s.kind = kind;
  s.material = env.material;
  s.tag = env.tag;
  return s;
}

bool Interpreter::withinBytes(const Span& span, uint32_t activation) {
  const size_t used = draft_.bytes() + activations_.size() * sizeof(Activation) + anchors_.size() * sizeof(Anchor) +
                      segments_.size() * sizeof(Segment) + plans_.size() * (sizeof(PlanPiece) + 4 * sizeof(PlanCorner));
  if (used <= limits_.bytes) return true;
  fail("one cell takes more than " + std::to_string(limits_.bytes >> 20) +
           " MiB (derive less, or make the cells smaller)",
       span, activation);
  return false;
}

uint32_t Interpreter::addShape(Shape s, uint32_t ordinal, const Span& span, const Env& env, const ShapeList& children) {
  if (draft_.chunk().shapes.size() >= limits_.shapes) {
    fail("one cell has more than " + std::to_string(limits_.shapes) +
             " shapes (derive fewer, or make the cells smaller)",
         span, env.activation);
  } else {
    withinBytes(span, env.activation);
  }
  Origin origin;
  origin.key = env.key.child(kCombinerSalt + static_cast<uint64_t>(s.kind), ordinal);
  origin.activation = env.activation;
  origin.span = span;
  if (!children.empty() && s.inner_radius == 0) {
    const bool first_only = s.kind == ShapeKind::subtract || s.kind == ShapeKind::subtract_smooth;
    for (uint32_t child : children) {
      s.inner_radius = std::max(s.inner_radius, draft_.shape(child).inner_radius);
      if (first_only) break;
    }
  }
  return draft_.addShape(s, origin, children);
}

uint32_t Interpreter::united(const ShapeList& list, const StmtNode& s, const Env& env) {
  if (list.size() == 1) return list[0];
  return addShape(shapeIn(env, ShapeKind::unite), s.ordinal, s.span, env, list);
}

/// nullopt if the statement has no radius, or one that is not positive.
std::optional<double> Interpreter::smoothRadius(const StmtNode& s, const Env& env) {
  if (s.amount == kNoId) return std::nullopt;
  const double units = real(s.amount, env) * env.place.scale * kUnitsPerMetre;
  if (!(units > 0)) return std::nullopt;
  if (units < 1e9) return units;
  note("a smooth radius must be smaller than the world; this edge is left sharp", s.span, env.activation);
  return std::nullopt;
}

namespace {

bool blends(const StmtNode& s) {
  return (s.kind == StmtKind::unite && s.amount != kNoId) || s.kind == StmtKind::meet || s.kind == StmtKind::sum ||
         s.kind == StmtKind::morph || s.kind == StmtKind::displace || s.kind == StmtKind::warp;
}

}  // namespace

void Interpreter::statement(StmtId id, const Env& env, ShapeList& out) {
  if (failed() || id == kNoId) return;
  const StmtNode& s = program_.stmt(id);
  if (coarse_edge_ > 0 && !env.whole && blends(s)) {
    Env whole = env;
    whole.whole = true;
    statement(id, whole, out);
    return;
  }
  if (!step(1, s.span, env.activation)) return;
  const Nested nested(nesting_);
  if (!withinNesting(s.span, env.activation)) return;
  switch (s.kind) {
    case StmtKind::block:
      if (program_.overridesOf(s.tag).count > 0)
        tagged(s, s.tag, env, out);
      else
        block(s, env, out);
      break;
    case StmtKind::call:
      call(s.expr, s.ordinal, env, out);
      break;
    case StmtKind::unite:
      uniteSmooth(s, env, out);
      break;
    case StmtKind::cut:
      cut(s, env, out);
      break;
    case StmtKind::meet:
      if (const uint16_t tag = program_.stmt(s.body).tag; program_.overridesOf(tag).count > 0)
        tagged(s, tag, env, out);
      else
        meet(s, env, out);
      break;
    case StmtKind::sum:
      sum(s, env, out);
      break;
    case StmtKind::morph:
      morph(s, env, out);
      break;
    case StmtKind::displace:
      displace(s, env, out);
      break;
    case StmtKind::warp:
      warp(s, env, out);
      break;
    case StmtKind::transform: {
      Env inner = env;
      transform(s.xforms, inner);
      statement(s.body, inner, out);
      break;
    }
    case StmtKind::repeat:
      repeat(s, env, out);
      break;
    case StmtKind::for_each:
      forEach(s, env, out);
      break;
    case StmtKind::scatter:
      scatter(s, env, out);
      break;
    case StmtKind::split:
      split(s, env, out);
      break;
    case StmtKind::snap:
      snap(s, env, out);
      break;
    case StmtKind::comp:
      comp(s, env, out);
      break;
    case StmtKind::treemap:
      treemap(s, env, out);
      break;
    case StmtKind::wfc:
      wave(s, env, out);
      break;
    case StmtKind::footprint:
      footprint(s, env);
      break;
    case StmtKind::extrude:
      if (const uint16_t tag = s.body == kNoId ? uint16_t{0} : program_.stmt(s.body).tag;
          program_.overridesOf(tag).count > 0)
        tagged(s, tag, env, out);
      else
        extrude(s, env, out);
      break;
    case StmtKind::roof:
      roof(s, env, out);
      break;
    case StmtKind::fit:
      fit(s, env, out);
      break;
    case StmtKind::let:
      if (env.slots != nullptr && s.slot < env.slots->size()) (*env.slots)[s.slot] = evaluate(s.expr, env);
      break;
    case StmtKind::anchor:
      anchor(s, env);
      break;
    case StmtKind::detail:
      detail(s, env, out);
      break;
    case StmtKind::inner:
      inner(s, env, out);
      break;
    case StmtKind::field:  // evaluated when used
    case StmtKind::mat:    // the checker has put both on the block
    case StmtKind::tag:
    case StmtKind::link:  // its treemap has read it
    case StmtKind::border:
      break;
  }
}

void Interpreter::label(const StmtNode& block, Env& env) const {
  if (block.material != 0) env.written_material = block.material;
  if (block.tag != 0) env.written_tag = block.tag;
  if (block.material != 0 && env.forced_material == 0) env.material = block.material;
  if (block.tag != 0 && env.forced_tag == 0) env.tag = block.tag;
}

void Interpreter::block(const StmtNode& s, const Env& env, ShapeList& out) {
  ShapeList own;
  contents(s, env, own);
  out.insert(out.end(), own.begin(), own.end());
}

void Interpreter::contents(const StmtNode& s, const Env& env, ShapeList& out) {
  Env inner = env;
  inner.cut_detail = 0;
  label(s, inner);
  for (uint32_t i = 0; i < s.children.count; ++i) statement(program_.idAt(s.children, i), inner, out);
}

void Interpreter::uniteSmooth(const StmtNode& s, const Env& env, ShapeList& out) {
  ShapeList body;
  statement(s.body, env, body);
  const std::optional<double> radius = smoothRadius(s, env);
  if (!radius || body.size() < 2) {
    out.insert(out.end(), body.begin(), body.end());
    return;
  }
  Shape node = shapeIn(env, ShapeKind::unite_smooth);
  node.amount = static_cast<float>(*radius);
  out.push_back(addShape(node, s.ordinal, s.span, env, body));
}

void Interpreter::cut(const StmtNode& s, const Env& env, ShapeList& out) {
  ShapeList body;
  Env inner = env;
  inner.cut_detail = 0;
  statement(s.body, inner, body);
  if (failed() || body.empty()) return;
  limitLevels(body, 0, 0, env.cut_detail);
  const std::optional<double> radius = smoothRadius(s, env);
  if (s.layer_level && env.top) {
    if (radius && body.size() > 1) {
      Shape node = shapeIn(env, ShapeKind::unite_smooth);
      node.amount = static_cast<float>(*radius);
      body = {addShape(node, s.ordinal, s.span, env, body)};
    }
    layer_cuts_.insert(layer_cuts_.end(), body.begin(), body.end());
    return;
  }
  if (out.empty()) return;  // nothing precedes: there is nothing to cut
  ShapeList operands{united(out, s, env)};
  operands.insert(operands.end(), body.begin(), body.end());
  Shape node = shapeIn(env, radius ? ShapeKind::subtract_smooth : ShapeKind::subtract);
  node.amount = static_cast<float>(radius.value_or(0));
  out = {addShape(node, s.ordinal, s.span, env, operands)};
}

void Interpreter::meet(const StmtNode& s, const Env& env, ShapeList& out) {
  const StmtNode& body = program_.stmt(s.body);
  if (body.kind != StmtKind::block) {
    statement(s.body, env, out);
    return;
  }
  Env inner = env;
  inner.cut_detail = 0;
  label(body, inner);
  ShapeList operands;
  for (uint32_t i = 0; i < body.children.count && !failed(); ++i) {
    const StmtNode& child = program_.stmt(program_.idAt(body.children, i));
    if (program_.stmt(program_.innermost(program_.idAt(body.children, i))).kind == StmtKind::cut) {
      // Cuts from the intersection of the preceding operands.
      if (operands.size() > 1)
        operands = {addShape(shapeIn(inner, ShapeKind::meet), child.ordinal, s.span, inner, operands)};
      statement(program_.idAt(body.children, i), inner, operands);
      continue;
    }
    ShapeList list;
    statement(program_.idAt(body.children, i), inner, list);
    if (isSilent(child.kind)) continue;
    if (list.empty()) {
      note("one operand of this meet is missing or was left out, so the whole meet is left out: let each give a shape",
           child.span, env.activation);
      return;
    }
    operands.push_back(united(list, child, inner));
  }
  if (failed() || operands.empty()) return;
  if (operands.size() == 1) {
    out.push_back(operands[0]);
    return;
  }
  const std::optional<double> radius = smoothRadius(s, env);
  Shape node = shapeIn(inner, radius ? ShapeKind::meet_smooth : ShapeKind::meet);
  node.amount = static_cast<float>(radius.value_or(0));
  out.push_back(addShape(node, s.ordinal, s.span, inner, operands));
}

void Interpreter::sum(const StmtNode& s, const Env& env, ShapeList& out) {
  ShapeList body;
  statement(s.body, env, body);
  std::erase_if(body, [&](uint32_t i) {
    if (draft_.shape(i).inner_radius > 0) return false;
    note(
        "a sum is of shapes with an inner radius, and a half-space has none; this one is left out: cut or meet the sum "
        "with it",
        draft_.origin(i).span, draft_.origin(i).activation);
    return true;
  });
  if (failed() || body.empty()) return;
  out.push_back(addShape(shapeIn(env, ShapeKind::sum), s.ordinal, s.span, env, body));
}

void Interpreter::displace(const StmtNode& s, const Env& env, ShapeList& out) {
  ShapeList body;
  statement(s.body, env, body);
  if (failed() || body.empty()) return;
  const uint32_t child = united(body, s, env);
  Env inner = env;
  if (draft_.sweepOf(child) != kNone) inner.sweep = draft_.sweepOf(child);
  Num by = evaluate(s.expr, inner).n[0];
  if (s.amount != kNoId) {
    const double most = std::fabs(real(s.amount, env));
    by = draft_.clamp(by, {-most}, {most});
  }
  by = draft_.binary(ExprOp::multiply, {env.place.scale}, by);
  if (by.constant() && by.value == 0) {
    out.push_back(child);
    return;
  }
  Shape node = shapeIn(env, ShapeKind::displace);
  node.expr = draft_.expression(by);
  out.push_back(addShape(node, s.ordinal, s.span, env, {child}));
}

/// Converts a vector of the field from the scope to the world.
std::array<Num, 3> Interpreter::inWorld(const std::array<Num, 3>& local, const Placement& place) {
  std::array<Num, 3> world;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      const Num part = draft_.binary(ExprOp::multiply, {place.scale * place.axes[3 * i + j]}, local[j]);
      world[i] = draft_.binary(ExprOp::add, world[i], part);
    }
  }
  return world;
}

void Interpreter::warp(const StmtNode& s, const Env& env, ShapeList& out) {
  ShapeList body;
  statement(s.body, env, body);
  if (failed() || body.empty()) return;
  const uint32_t child = united(body, s, env);
  Env inner = env;
  if (draft_.sweepOf(child) != kNone) inner.sweep = draft_.sweepOf(child);
  std::array<Num, 3> by = evaluate(s.expr, inner).n;
  if (s.amount != kNoId) {
    const double most = std::fabs(real(s.amount, env));
    for (Num& n : by) n = draft_.clamp(n, {-most}, {most});
  }
  by = inWorld(by, env.place);
  Shape node = shapeIn(env, ShapeKind::warp);
  node.expr = draft_.triple(by);
  out.push_back(addShape(node, s.ordinal, s.span, env, {child}));
}

void Interpreter::limitLevels(ShapeList& list, size_t from, int32_t coarsest, int32_t detail_edge) {
  for (size_t i = from; i < list.size(); ++i) {
    Shape& s = draft_.shape(list[i]);
    s.coarsest = std::max(s.coarsest, coarsest);
    if (detail_edge > 0) s.detail = s.detail > 0 ? std::min(s.detail, detail_edge) : detail_edge;
  }
}

void Interpreter::detail(const StmtNode& s, const Env& env, ShapeList& out) {
  const int32_t edge = std::max(1, toUnits(real(s.expr, env)));
  if (skips(edge, env)) return;
  const StmtNode& inside = program_.stmt(program_.innermost(s.body));
  if (inside.kind == StmtKind::cut && !(inside.layer_level && env.top)) {
    Env inner = env;
    inner.cut_detail = env.cut_detail > 0 ? std::min(env.cut_detail, edge) : edge;
    statement(s.body, inner, out);
    return;
  }
  ShapeList body;
  const size_t first_cut = layer_cuts_.size();
  statement(s.body, env, body);
  limitLevels(body, 0, 0, edge);
  limitLevels(layer_cuts_, first_cut, 0, edge);
  out.insert(out.end(), body.begin(), body.end());
}

}  // namespace sgm
