#include "derive/interpret/leaves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/math.h"
#include "derive/draws.h"
#include "derive/sweep.h"

namespace sgm::interpret {
namespace {

constexpr double kLargest = 1073741824.0;  ///< largest size of a primitive in units: a quarter of the world's edge

/// Adds a leaf shape. metres: sizes that are scaled to units and appended to the entries of shape.size that are already
/// set (such as an exponent). inner: inner radius in metres.
void addLeaf(Shape shape, std::initializer_list<double> metres, double inner, const ExprNode& node, uint32_t ordinal,
             CellContext& c, const Env& env, ShapeList& out) {
  if (c.budget.failed()) return;
  const double scale = env.place.scale * kUnitsPerMetre;
  size_t i = 0;
  for (double m : metres) {
    const double units = m * scale;
    const bool pointed = shape.kind == ShapeKind::truncone && i < 2 && units == 0;
    if (units == 0 && shape.kind == ShapeKind::box && std::min({env.scope.x, env.scope.y, env.scope.z}) == 0) {
      c.budget.note(
          "this box has an edge of 0, as the scope of a face has; it is left out: give it a depth, such as "
          "size(z 0.2m) box(scope)",
          node.span, env.activation);
      return;
    }
    if (!(units > 0 && units <= kLargest) && !pointed) {
      c.budget.note(
          "a size of this shape is not positive, or larger than the world; the shape is left out: bound it, such as "
          "max(r, 0.1m)",
          node.span, env.activation);
      return;
    }
    shape.size[i++] = static_cast<float>(units);
  }
  shape.inner_radius = static_cast<float>(inner * scale);
  out.push_back(c.sink.addShape(shape, ordinal, node.span, env));
}

void boxLeaf(const ExprNode& node, uint32_t ordinal, CellContext& c, const Env& env, ShapeList& out) {
  const Value first = c.evaluator.evaluate(c.evaluator.boundAt(node, 0), env);
  Vec3 v = first.vec();
  if (first.kind != ValueKind::vector) {
    v.y = c.evaluator.boundAt(node, 1) == kNoId ? v.x : c.evaluator.real(c.evaluator.boundAt(node, 1), env);
    v.z = c.evaluator.boundAt(node, 2) == kNoId ? v.x : c.evaluator.real(c.evaluator.boundAt(node, 2), env);
  }
  const bool round = static_cast<Primitive>(node.id) == Primitive::ellipsoid;
  if (!round) v = 0.5 * v;
  Shape shape = shapeIn(env, round ? ShapeKind::ellipsoid : ShapeKind::box);
  shape.frame = env.place.frame();
  addLeaf(shape, {v.x, v.y, v.z}, std::min({v.x, v.y, v.z}), node, ordinal, c, env, out);
}

void halfspaceLeaf(const ExprNode& node, uint32_t ordinal, CellContext& c, const Env& env, ShapeList& out) {
  const bool above = c.evaluator.boundAt(node, 1) != kNoId;
  const double height = c.evaluator.real(c.evaluator.boundAt(node, above ? 1 : 0), env);
  const Placement place = above ? env.place.turned({1, 0, 0}, kPi) : env.place;
  Shape shape = shapeIn(env, ShapeKind::halfspace);
  shape.frame = place.frame({0, above ? -height : height, 0});
  addLeaf(shape, {}, 0, node, ordinal, c, env, out);
}

void prismLeaf(const ExprNode& node, uint32_t ordinal, CellContext& c, const Env& env, ShapeList& out) {
  const double half = 0.5 * c.evaluator.real(c.evaluator.boundAt(node, 0), env);
  std::vector<Int3> corners;
  Int3 low{std::numeric_limits<int32_t>::max(), 0, std::numeric_limits<int32_t>::max()};
  Int3 high{std::numeric_limits<int32_t>::min(), 0, std::numeric_limits<int32_t>::min()};
  for (uint32_t i = 1; i < node.bound.count; ++i) {
    const Value pair = c.evaluator.evaluate(c.evaluator.boundAt(node, i), env);
    const Int3 corner{toUnits(pair.n[0].value * env.place.scale), 0, toUnits(pair.n[1].value * env.place.scale)};
    low = {std::min(low.x, corner.x), 0, std::min(low.z, corner.z)};
    high = {std::max(high.x, corner.x), 0, std::max(high.z, corner.z)};
    if (corners.empty() || corners.back() != corner) corners.push_back(corner);
  }
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  if (corners.size() < 3) {
    return c.budget.note("a prism needs three corners that lie apart; this one is left out", node.span, env.activation);
  }
  Shape shape = shapeIn(env, ShapeKind::prism);
  shape.frame = env.place.frame();
  shape.first_point = c.draft.addPrismPoints(corners);
  shape.point_count = static_cast<uint32_t>(corners.size());
  const Int3 extent = saturatingSub(high, low);
  const double across = 0.5 * std::min(extent.x, extent.z) / (env.place.scale * kUnitsPerMetre);
  addLeaf(shape, {half}, std::min(half, across), node, ordinal, c, env, out);
}

void sweptLeaf(bool square, const ExprNode& node, uint32_t ordinal, CellContext& c, const Env& env, ShapeList& out) {
  const Int3 a = env.place.snap(c.evaluator.evaluate(c.evaluator.boundAt(node, 0), env).vec());
  const Int3 b = env.place.snap(c.evaluator.evaluate(c.evaluator.boundAt(node, 1), env).vec());
  const double scale = env.place.scale * kUnitsPerMetre;
  const double r = c.evaluator.real(c.evaluator.boundAt(node, 2), env) * scale;
  const double bend =
      c.evaluator.boundAt(node, 3) == kNoId ? 0.0 : c.evaluator.real(c.evaluator.boundAt(node, 3), env) * scale;
  if (c.budget.failed()) return;
  if (!(r > 0 && r <= kLargest && bend >= 0 && bend <= kLargest)) {
    return c.budget.note("a tube or a beam needs a radius above 0 and a bend of 0 or more; this one is left out",
                         node.span, env.activation);
  }
  // The key of the bend depends only on the two end points, so that a tube and a beam between the same points bend
  // equally.
  PathKey key = c.in.lattice.cellKey(c.in.cell).child(kBendSalt, 0);
  for (const Int3& end : {saturatingSub(a, c.in.base), saturatingSub(b, c.in.base)}) {
    for (int i = 0; i < 3; ++i) key = {hashCombine(key.value, static_cast<uint32_t>(end[i]))};
  }
  const std::vector<Int3> corners = bentLine(a, b, bend, key);
  if (corners.size() < 2) {
    return c.budget.note("a tube or a beam needs ends that lie apart; this one is left out", node.span, env.activation);
  }
  ShapeList pieces;
  if (square) {
    for (const BeamPiece& piece : beamAlong(corners, r, env.place.direction({0, 1, 0}))) {
      Shape shape = shapeIn(env, ShapeKind::box);
      shape.frame = piece.frame;
      std::copy(piece.half.begin(), piece.half.end(), shape.size.begin());
      shape.inner_radius = static_cast<float>(r);
      pieces.push_back(c.sink.addShape(shape, ordinal, node.span, env));
    }
  } else {
    for (size_t i = 0; i + 1 < corners.size(); ++i) {
      Shape shape = shapeIn(env, ShapeKind::capsule);
      shape.frame.origin = corners[i];
      const Int3 axis = saturatingSub(corners[i + 1], corners[i]);
      shape.size = {static_cast<float>(r),
                    static_cast<float>(axis.x),
                    static_cast<float>(axis.y),
                    static_cast<float>(axis.z),
                    0,
                    0};
      shape.inner_radius = static_cast<float>(r);
      pieces.push_back(c.sink.addShape(shape, ordinal, node.span, env));
    }
  }
  if (c.budget.failed()) return;
  Shape joint = shapeIn(env, ShapeKind::unite);
  joint.size[0] = static_cast<float>(r);
  const uint32_t whole = pieces.size() == 1 ? pieces[0] : c.sink.addShape(joint, ordinal, node.span, env, pieces);
  const uint32_t line = c.draft.addPolyline(corners);
  c.draft.setSweep(whole, line);
  c.draft.setLine(whole, line);
  out.push_back(whole);
}

}  // namespace

void addPrimitive(Primitive kind, const ExprNode& node, uint32_t ordinal, CellContext& c, const Env& env,
                  ShapeList& out) {
  const auto number = [&](uint32_t i) { return c.evaluator.real(c.evaluator.boundAt(node, i), env); };
  const auto leaf = [&](ShapeKind shape_kind) {
    Shape shape = shapeIn(env, shape_kind);
    shape.frame = env.place.frame();
    return shape;
  };
  switch (kind) {
    case Primitive::sphere:
    case Primitive::blob: {
      const double r = number(0);
      Shape shape = leaf(ShapeKind::sphere);
      shape.frame.rows = Frame{}.rows;  // A sphere has no orientation, so equal spheres get bitwise equal frames.
      return addLeaf(shape, {r}, r, node, ordinal, c, env, out);
    }
    case Primitive::box:
    case Primitive::ellipsoid:
      return boxLeaf(node, ordinal, c, env, out);
    case Primitive::cylinder: {
      const double r = number(0), half = 0.5 * number(1);
      return addLeaf(leaf(ShapeKind::cylinder), {r, half}, std::min(r, half), node, ordinal, c, env, out);
    }
    case Primitive::truncone: {
      const double half = 0.5 * number(0), top = number(1), bottom = number(2);
      if (top == 0 && bottom == 0) {
        return c.budget.note("a cone needs a radius above 0 at one end; this one is left out", node.span,
                             env.activation);
      }
      const double inner = std::min(std::max(top, bottom), half);
      return addLeaf(leaf(ShapeKind::truncone), {bottom, top, half}, inner, node, ordinal, c, env, out);
    }
    case Primitive::capsule: {
      const Int3 a = env.place.snap(c.evaluator.evaluate(c.evaluator.boundAt(node, 0), env).vec());
      const Int3 b = env.place.snap(c.evaluator.evaluate(c.evaluator.boundAt(node, 1), env).vec());
      const double r = number(2);
      Shape shape = shapeIn(env, ShapeKind::capsule);
      shape.frame.origin = a;
      const Int3 axis = saturatingSub(b, a);
      for (int i = 0; i < 3; ++i) shape.size[static_cast<size_t>(1 + i)] = static_cast<float>(axis[i]);
      return addLeaf(shape, {r}, r, node, ordinal, c, env, out);
    }
    case Primitive::torus: {
      const double ring = number(0), tube = number(1);
      return addLeaf(leaf(ShapeKind::torus), {ring, tube}, tube, node, ordinal, c, env, out);
    }
    case Primitive::superq: {
      const Vec3 radii = c.evaluator.evaluate(c.evaluator.boundAt(node, 0), env).vec();
      Shape shape = leaf(ShapeKind::superquadric);
      shape.size[3] = static_cast<float>(exponentOfSquare(number(1)));
      return addLeaf(shape, {radii.x, radii.y, radii.z}, std::min({radii.x, radii.y, radii.z}), node, ordinal, c, env,
                     out);
    }
    case Primitive::halfspace:
      return halfspaceLeaf(node, ordinal, c, env, out);
    case Primitive::tube:
      return sweptLeaf(false, node, ordinal, c, env, out);
    case Primitive::beam:
      return sweptLeaf(true, node, ordinal, c, env, out);
    case Primitive::prism:
      return prismLeaf(node, ordinal, c, env, out);
    case Primitive::ca:
      return addAutomaton(node, ordinal, c, env, out);
  }
}

}  // namespace sgm::interpret
