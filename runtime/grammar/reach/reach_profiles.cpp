// Computes extents of footprints, their extrusions, roofs and fitted assets.

#include <algorithm>

#include "base/math.h"
#include "grammar/range/reach_shapes.h"
#include "grammar/reach/kept_scope.h"
#include "grammar/reach/reach_statements.h"
#include "grammar/syntax/profile_limits.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm::reach {

namespace {

constexpr Interval kMiddle{0.5, 0.5};
/// Margin in metres, because derivation cuts a roof off slightly above its peak, and rounds heights
/// (derive/interpret/profiles.cpp).
constexpr double kRounding = 4.0 / kUnitsPerMetre;

Interval symmetric(Interval v) { return {-v.hi, v.hi}; }

}  // namespace

RangeValue evaluateFootprint(const FootprintNode& plan, const RangeFrame& frame, ReachContext& context) {
  RangeValue out;
  out.kind = ValueKind::plan;
  const auto number = [&](uint32_t i) {
    return positivePart(context.values.number(context.program.idAt(plan.bound, i), frame));
  };
  out.v[1] = out.at[1] = Interval{};
  switch (plan.outline) {
    case Outline::rect:
      out.v[0] = number(0);
      out.v[2] = number(1);
      break;
    case Outline::regular:
      // The edges of the bounding box of a regular polygon are 1.5 radii (triangle) to 2 radii long.
      out.v[0] = out.v[2] = number(1) * Interval{1.5, 2};
      break;
    case Outline::polygon: {
      IntervalVector low = context.values.vector(context.program.idAt(plan.bound, 0), frame), high = low;
      for (uint32_t i = 1; i < plan.bound.count; ++i) {
        const IntervalVector corner = context.values.vector(context.program.idAt(plan.bound, i), frame);
        for (size_t k = 0; k < 2; ++k) {
          low[k] = minimum(low[k], corner[k]);
          high[k] = maximum(high[k], corner[k]);
        }
      }
      for (size_t k = 0; k < 2; ++k) {
        out.v[2 * k] = positivePart(high[k] - low[k]);
        out.at[2 * k] = (low[k] + high[k]) * kMiddle;
      }
      return out;
    }
  }
  const bool merged = plan.count != kNoId && !(context.values.number(plan.count, frame).hi < 1.5);
  for (size_t axis : {size_t{0}, size_t{2}}) out.at[axis] = merged ? symmetric(out.v[axis] * kMiddle) : Interval{};
  return out;
}

Extent boundExtrude(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  const RangeValue plan = context.values.evaluate(s.plan, frame);
  const Interval height = positivePart(context.values.number(s.expr, frame));
  const IntervalVector middle{plan.at[0], height * kMiddle, plan.at[2]};
  const KeptScope kept(frame);
  frame.scope = {plan.v[0], height, plan.v[2]};
  frame.place.move(middle);
  Extent e = solidIn(frame.scope);
  if (s.body != kNoId) e = boundBlock(context.program.stmt(s.body), frame, context, std::move(e));
  e.repeat({0, kMergeRange.high});
  e.move(middle);
  e.attribute(s.plan);
  return e;
}

Extent boundRoof(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  const RoofNode& roof = context.program.ast.roofs[s.extra];
  RangeValue plan = RangeValue::vector(frame.scope);
  Interval overhang = roof.overhang == kNoId ? Interval{} : positivePart(context.values.number(roof.overhang, frame));
  Interval floor = -(frame.scope[1] * kMiddle);
  if (s.plan != kNoId) {
    plan = context.values.evaluate(s.plan, frame);
    floor = Interval::exactly(-kSeamOverlap);
    overhang = overhang * Interval::exactly(kMaxMiter);
  }
  IntervalVector edges = plan.v;
  for (size_t axis : {size_t{0}, size_t{2}}) edges[axis] = positivePart(edges[axis]) + overhang + overhang;
  const Interval measure = context.values.number(roof.measure, frame);
  if (roof.form == RoofForm::flat) {
    edges[1] = positivePart(measure);
  } else {
    const double pitch = std::clamp(measure.hi, kLeastPitch, kMaxPitch);
    const double slope = detSin(pitch) / detCos(pitch) * (1 + 1e-12);
    edges[1] = {0, boundProduct(slope, std::min(edges[0].hi, edges[2].hi)) / 2 + kRounding};
  }
  Extent e = solidIn(edges);
  e.repeat({0, kMergeRange.high});
  e.move({plan.at[0], floor + edges[1] * kMiddle, plan.at[2]});
  if (s.plan != kNoId) e.attribute(s.plan);
  return e;
}

/// A fitted asset fills the scope's box exactly, or is left out.
Extent boundFit(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  const FitNode& fit = context.program.ast.fits[s.extra];
  for (uint32_t i = 0; i < fit.zones.count; ++i) {
    const FitZoneNode& zone = context.program.ast.fit_zones[fit.zones.first + i];
    // both ends are evaluated only to record the queries in them
    for (const ExprId end : {zone.from, zone.to}) context.values.number(end, frame);
  }
  return solidIn(frame.scope);
}

}  // namespace sgm::reach
