// Derives footprints, their extrusions, and roofs.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/math.h"
#include "derive/draws.h"
#include "derive/interpret/statements.h"
#include "grammar/syntax/profile_limits.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm::interpret {
namespace {

constexpr double kLargestSolid = 1073741824.0;  ///< largest size of a solid in units: a quarter of the world's edge

std::string broken(const ValueRange& range) {
  return std::string(range.rule).append(", ").append(range.example).append("; this one is left out");
}

std::optional<PlanPiece> planPiece(const FootprintNode& node, CellContext& c, const Env& env) {
  const auto number = [&](uint32_t i) { return c.evaluator.real(c.program.idAt(node.bound, i), env); };
  const auto length = [](double metres) { return metres > 0 && metres * kUnitsPerMetre <= kLargestSolid; };
  switch (node.outline) {
    case Outline::rect: {
      const double x = number(0), z = number(1);
      if (length(x) && length(z)) return rectPiece(x, z);
      break;
    }
    case Outline::regular: {
      const double count = detFloor(number(0) + 0.5), radius = number(1);
      if (!kCornerRange.holds(count)) {
        c.budget.note(broken(kCornerRange), node.span, env.activation);
        return std::nullopt;
      }
      if (length(radius)) return regularPiece(static_cast<int>(count), radius);
      break;
    }
    case Outline::polygon: {
      std::vector<PlanCorner> corners;
      for (uint32_t i = 0; i < node.bound.count; ++i) {
        const Value pair = c.evaluator.evaluate(c.program.idAt(node.bound, i), env);
        corners.push_back({pair.n[0].value, pair.n[1].value});
      }
      const PlanPiece piece = polygonPiece(corners);
      if (!length(piece.x) || !length(piece.z)) break;
      if (isSimple(piece)) return piece;
      c.budget.note(
          "the edges of this polygon cross, or hold no area; it is left out: give its corners in order around it",
          node.span, env.activation);
      return std::nullopt;
    }
  }
  c.budget.note(
      "a size of this footprint is not positive, or larger than the world; the piece is left out: bound it, such as "
      "max(x, 1m)",
      node.span, env.activation);
  return std::nullopt;
}

/// A polygon that is extruded from y = 0 to `height` metres. x, z: edges of its bounding box, metres.
struct Profile {
  std::vector<PlanCorner> corners;
  double x, z, height;
};

std::optional<uint32_t> prismShape(const Profile& profile, const Placement& place, uint32_t ordinal, const Span& span,
                                   CellContext& c, const Env& env) {
  const double scale = place.scale * kUnitsPerMetre, half = 0.5 * profile.height * scale;
  std::vector<Int3> corners;
  for (const PlanCorner& at : profile.corners) {
    const Int3 corner{toUnits(at.x * place.scale), 0, toUnits(at.z * place.scale)};
    if (corners.empty() || corners.back() != corner) corners.push_back(corner);
  }
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  if (!(half > 0 && half <= kLargestSolid) || corners.size() < 3) {
    c.budget.note(
        "a size of this solid is not positive, or larger than the world; it is left out: bound it, such as max(h, 1m)",
        span, env.activation);
    return std::nullopt;
  }
  Shape shape = shapeIn(env, ShapeKind::prism);
  shape.frame = place.frame({0, 0.5 * profile.height, 0});
  shape.first_point = c.draft.addPrismPoints(corners);
  shape.point_count = static_cast<uint32_t>(corners.size());
  shape.size[0] = static_cast<float>(half);
  shape.inner_radius = static_cast<float>(std::min(half, 0.5 * scale * std::min(profile.x, profile.z)));
  return c.sink.addShape(shape, ordinal, span, env);
}

/// Derives a roof: the outline, extruded to the roof's maximum height, intersected with one inclined half-space for
/// each edge from which the roof slopes up.
void roofOver(const PlanPiece& piece, double floor, const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const RoofNode& node = c.program.ast.roofs[s.extra];
  const double measure = c.evaluator.real(node.measure, env);
  const double overhang = node.overhang == kNoId ? 0.0 : c.evaluator.real(node.overhang, env);
  if (c.budget.failed()) return;
  const bool flat = node.form == RoofForm::flat, gable = node.form == RoofForm::gable;
  if (!kOverhangRange.holds(overhang)) return c.budget.note(broken(kOverhangRange), s.span, env.activation);
  if (!flat && !kPitchRange.holds(measure)) return c.budget.note(broken(kPitchRange), s.span, env.activation);
  if (gable && !piece.rect)
    return c.budget.note("a gable stands on rectangles; this roof is left out: take `hip`", s.span, env.activation);
  if (!flat && !isConvex(piece))
    return c.budget.note("a hip stands on convex outlines; this roof is left out: merge rectangles, or take `flat`",
                         s.span, env.activation);
  const std::vector<PlanCorner> corners = grownOutline(piece, overhang);
  if (!isConvex(piece) && !isSimple(piece, corners))
    return c.budget.note(
        "this overhang grows together in a notch of the outline; the roof is left out: use a smaller overhang, or "
        "merge rectangles",
        s.span, env.activation);
  const auto grown = [&](double edge, double PlanCorner::*axis) {
    for (const PlanCorner& corner : corners) edge = std::max(edge, 2 * std::fabs(corner.*axis));
    return edge;
  };
  const double x = grown(piece.x, &PlanCorner::x), z = grown(piece.z, &PlanCorner::z);
  // The extrusion is slightly higher than the peak: ending exactly at the peak would flatten the ridge because of
  // rounding.
  const double height =
      flat ? measure : 0.5 * std::min(x, z) * detSin(measure) / detCos(measure) + 2.0 / kUnitsPerMetre;
  const Placement place = env.place.moved({piece.middle.x, floor, piece.middle.z});
  const auto body = prismShape({corners, x, z, height}, place, s.ordinal, s.span, c, env);
  if (!body) return;
  ShapeList parts{*body};
  for (size_t i = 0; i < corners.size() && !flat && !c.budget.failed(); ++i) {
    // Corner 0 of a rectangle has the lowest x and z, so edges 0 and 2 run along x.
    if (gable && (i % 2 == 0) != (x >= z)) continue;
    const PlanCorner a = corners[i], b = corners[(i + 1) % corners.size()];
    const double out_x = b.z - a.z, out_z = a.x - b.x;
    if (out_x == 0 && out_z == 0) continue;
    Shape slope = shapeIn(env, ShapeKind::halfspace);
    slope.frame = place.moved({0.5 * (a.x + b.x), 0, 0.5 * (a.z + b.z)})
                      .turned({0, 1, 0}, detAtan2(out_x, out_z))
                      .turned({1, 0, 0}, measure)
                      .frame();
    parts.push_back(c.sink.addShape(slope, s.ordinal, s.span, env));
  }
  out.push_back(flat ? *body : c.sink.addShape(shapeIn(env, ShapeKind::meet), s.ordinal, s.span, env, parts));
}

}  // namespace

void runFootprint(const StmtNode& s, CellContext& c, const Env& env) {
  if (env.slots == nullptr || s.slot >= env.slots->size()) return;
  const FootprintNode& node = c.program.ast.footprints[s.extra];
  const uint32_t first = c.evaluator.pieceCount();
  const double count = node.count == kNoId ? 1 : detFloor(c.evaluator.real(node.count, env) + 0.5);
  if (!kMergeRange.holds(count)) {
    c.budget.note(broken(kMergeRange), s.span, env.activation);
  } else {
    Env inner = env;
    for (double i = 0; i < count && !c.budget.failed(); ++i) {
      if (!c.budget.step(1, s.span, env.activation)) break;
      inner.key = env.key.child(kLoopSalt + s.ordinal, static_cast<uint64_t>(i));
      std::optional<PlanPiece> piece = planPiece(node, c, inner);
      if (!piece) continue;
      if (c.evaluator.pieceCount() > first) putOnOutline(*piece, c.evaluator.piece(first), inner.key);
      c.evaluator.addPiece(std::move(*piece));
    }
  }
  (*env.slots)[s.slot] = Value::ofPlan(first, c.evaluator.pieceCount() - first);
}

void runExtrude(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const Value plan = c.evaluator.evaluate(s.plan, env);
  for (uint32_t i = 0; i < plan.count && !c.budget.failed(); ++i) {
    if (!c.budget.step(1, s.span, env.activation)) return;
    const PlanPiece piece = c.evaluator.piece(plan.first + i);
    Env inner = env;
    inner.cut_detail = 0;
    inner.key = env.key.child(kLoopSalt + s.ordinal, i);
    if (s.body != kNoId) label(c.program.stmt(s.body), inner);
    inner.place = env.place.moved({piece.middle.x, 0, piece.middle.z});
    const double height = c.evaluator.real(s.expr, inner);
    const auto solid = prismShape({piece.corners, piece.x, piece.z, height}, inner.place, s.ordinal, s.span, c, inner);
    if (!solid) continue;
    ShapeList own{*solid};
    inner.place = inner.place.moved({0, 0.5 * height, 0});
    inner.scope = {piece.x, height, piece.z};
    for (uint32_t k = 0; s.body != kNoId && k < c.program.stmt(s.body).children.count; ++k)
      runStatement(c.program.idAt(c.program.stmt(s.body).children, k), c, inner, own);
    out.insert(out.end(), own.begin(), own.end());
  }
}

void runRoof(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  if (s.plan == kNoId) {
    if (!(env.scope.x > 0 && env.scope.z > 0))
      return c.budget.note(
          "this scope's box has no size along x or z, so it gets no roof: give it one, such as size(8m, 3m, 6m)",
          s.span, env.activation);
    return roofOver(rectPiece(env.scope.x, env.scope.z), -0.5 * env.scope.y, s, c, env, out);
  }
  const Value plan = c.evaluator.evaluate(s.plan, env);
  for (uint32_t i = 0; i < plan.count && !c.budget.failed(); ++i) {
    if (!c.budget.step(1, s.span, env.activation)) return;
    Env inner = env;
    inner.key = env.key.child(kLoopSalt + s.ordinal, i);
    // The roof overlaps the extrusion below instead of only touching its face; see kSeamOverlap.
    roofOver(c.evaluator.piece(plan.first + i), -kSeamOverlap, s, c, inner, out);
  }
}

}  // namespace sgm::interpret
