// Derives morphs: a linear blend of two fields, or one superquadric whose exponent changes.

#include <algorithm>
#include <array>

#include "derive/interpret/leaves.h"
#include "derive/interpret/statements.h"

namespace sgm::interpret {
namespace {

/// A leaf described as a superquadric: its radii, and its squareness from 0 (an ellipsoid) to 1 (the largest exponent,
/// which stands for a box).
struct Squared {
  std::array<double, 3> radii{};
  double square = 0;
  bool turns = true;  ///< true if a rotation changes the shape; false for a sphere
};

/// Describes a sphere, an ellipsoid, a box or a superquadric as a superquadric.
Squared squaredOf(const Shape& s) {
  Squared result;
  const bool ball = s.kind == ShapeKind::sphere;
  for (size_t i = 0; i < 3; ++i) result.radii[i] = static_cast<double>(s.size[ball ? 0 : i]);
  result.turns = !ball;
  if (ball || s.kind == ShapeKind::ellipsoid) return result;
  result.square = 1;
  if (s.kind == ShapeKind::box) return result;
  const double most = 1.0 - 2.0 / static_cast<double>(kMaxPower);
  result.square = std::clamp((1.0 - 2.0 / static_cast<double>(s.size[3])) / most, 0.0, 1.0);
  return result;
}

void morphByPower(const StmtNode& s, CellContext& c, const Env& env, uint32_t a, uint32_t b, Num t, ShapeList& out) {
  // The checker ensures that both shapes are leaves of the same scope, so they have the same centre and axes.
  const Squared from = squaredOf(c.draft.shape(a)), to = squaredOf(c.draft.shape(b));
  const auto mixed = [](double low, double high, double at) { return low + (high - low) * at; };
  Shape node = shapeIn(env, ShapeKind::superquadric);
  node.frame = c.draft.shape(from.turns ? a : b).frame;
  if (t.constant()) {
    for (size_t i = 0; i < 3; ++i) node.size[i] = static_cast<float>(mixed(from.radii[i], to.radii[i], t.value));
    node.size[3] = static_cast<float>(exponentOfSquare(mixed(from.square, to.square, t.value)));
    node.inner_radius = std::min({node.size[0], node.size[1], node.size[2]});
    out.push_back(c.sink.addShape(node, s.ordinal, s.span, env));
    return;
  }
  // The shape kind morph_power always runs from squareness 0 to squareness 1. If the two shapes have squarenesses
  // within this range, their radii and t are extrapolated linearly to its ends.
  node.kind = ShapeKind::morph_power;
  const double step = to.square - from.square;
  for (size_t i = 0; i < 3; ++i) {
    const double slope = step == 0 ? 0 : (to.radii[i] - from.radii[i]) / step;
    const double at_round = from.radii[i] - slope * from.square;
    node.size[i] = static_cast<float>(at_round);
    node.size[3 + i] = static_cast<float>(at_round + slope);
    if (!(node.size[i] > 0 && node.size[3 + i] > 0) || (step == 0 && to.radii[i] != from.radii[i])) {
      c.budget.note("morph by power cannot change the radii so much for so little change of squareness; use lerp here",
                    s.span, env.activation);
      return;
    }
  }
  node.inner_radius = std::max(c.draft.shape(a).inner_radius, c.draft.shape(b).inner_radius);
  const Num along = c.draft.clamp(t, {0}, {1});
  node.expr =
      c.draft.expression(c.draft.binary(ExprOp::add, {from.square}, c.draft.binary(ExprOp::multiply, {step}, along)));
  out.push_back(c.sink.addShape(node, s.ordinal, s.span, env));
}

}  // namespace

double exponentOfSquare(double square) {
  const double s = std::clamp(square, 0.0, 1.0);
  return 2.0 / (1.0 - s + s * 2.0 / static_cast<double>(kMaxPower));
}

void runMorph(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const StmtId from = c.program.idAt(s.children, 0), to = c.program.idAt(s.children, 1);
  // A parameter t that is known only at sample time may use `u`, the coordinate along the morphed shapes. So t is
  // evaluated after both shapes are derived.
  const bool sampled = c.program.expr(s.expr).type.sample;
  Num t = sampled ? Num{} : c.evaluator.evaluate(s.expr, env).n[0];
  if (!sampled && !(t.value > 0)) return runStatement(from, c, env, out);
  if (!sampled && t.value >= 1) return runStatement(to, c, env, out);
  ShapeList a, b;
  runStatement(from, c, env, a);
  runStatement(to, c, env, b);
  if (c.budget.failed()) return;
  if (a.empty() || b.empty()) {
    c.budget.note(
        "one end of this morph is missing or was left out, so the whole morph is left out: let both give shapes",
        s.span, env.activation);
    return;
  }
  const uint32_t first = c.sink.unite(a, s, env), second = c.sink.unite(b, s, env);
  if (sampled) {
    Env inner = env;
    const uint32_t swept = c.draft.sweepOf(first) != kNone ? c.draft.sweepOf(first) : c.draft.sweepOf(second);
    if (swept != kNone) inner.sweep = swept;
    t = c.evaluator.evaluate(s.expr, inner).n[0];
    if (t.constant() && !(t.value > 0 && t.value < 1)) {
      const ShapeList& end = t.value >= 1 ? b : a;
      out.insert(out.end(), end.begin(), end.end());
      return;
    }
  }
  if (s.power) return morphByPower(s, c, env, first, second, t, out);
  Shape node = shapeIn(env, ShapeKind::morph);
  const double ra = static_cast<double>(c.draft.shape(first).inner_radius);
  const double rb = static_cast<double>(c.draft.shape(second).inner_radius);
  if (t.constant()) {
    node.amount = static_cast<float>(t.value);
    node.inner_radius = static_cast<float>(ra + (rb - ra) * t.value);
  } else {
    node.expr = c.draft.expression(t);
    node.inner_radius = static_cast<float>(std::max(ra, rb));
  }
  if (ra == 0 || rb == 0) node.inner_radius = 0;
  out.push_back(c.sink.addShape(node, s.ordinal, s.span, env, {first, second}));
}

}  // namespace sgm::interpret
