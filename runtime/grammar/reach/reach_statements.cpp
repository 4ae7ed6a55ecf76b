#include "grammar/reach/reach_statements.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/reach/reach_rules.h"
#include "grammar/text/codes.h"

namespace sgm::reach {

namespace {

/// True if statements of this kind derive no shapes.
bool isSilent(StmtKind kind) {
  return kind == StmtKind::let || kind == StmtKind::field || kind == StmtKind::mat || kind == StmtKind::tag ||
         kind == StmtKind::anchor || kind == StmtKind::footprint;
}

/// Returns the tag of a block; 0 for other statements and for kNoId.
uint16_t blockTag(StmtId body, const Program& program) {
  const bool block = body != kNoId && program.stmt(body).kind == StmtKind::block;
  return block ? program.stmt(body).tag : uint16_t{0};
}

/// Returns the extent of a whole block. out: the extent of its statements before index `next`.
Extent boundRestOfBlock(const StmtNode& s, uint32_t next, RangeFrame& frame, ReachContext& context, Extent out) {
  for (uint32_t i = next; i < s.children.count; ++i) {
    const StmtId child = context.program.idAt(s.children, i);
    const StmtNode& inner = context.program.stmt(context.program.innermost(child));
    const Extent part = boundStatement(child, frame, context);
    if (inner.kind == StmtKind::let && context.pieces.isDividing() && hasPieces(frame.slots[inner.slot])) {
      const uint32_t slot = inner.slot;
      const auto rest = [&] {
        RangeFrame at = frame;
        return boundRestOfBlock(s, i + 1, at, context, out);
      };
      return context.pieces.boundOver({&frame.slots[slot]}, rest, context.budget);
    }
    if (inner.kind == StmtKind::cut && !(inner.layer_level && frame.top)) {
      // A cut adds no shapes, but it may remove any part of the preceding content. So no part of that content is
      // certain any more.
      if (!part.empty) out.uncertain();
      out.node();
      continue;
    }
    out.join(part);
  }
  return out;
}

Extent boundMeet(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  const StmtNode& inner = context.program.stmt(s.body);
  if (inner.kind != StmtKind::block) return boundStatement(s.body, frame, context);
  std::optional<Extent> out;
  double inner_radius = 0, count = 0;
  bool missing = false;
  for (uint32_t i = 0; i < inner.children.count; ++i) {
    const StmtId child = context.program.idAt(inner.children, i);
    const Extent part = boundStatement(child, frame, context);
    if (isSilent(context.program.stmt(child).kind)) continue;
    if (context.program.stmt(context.program.innermost(child)).kind == StmtKind::cut) continue;
    missing = missing || part.empty;
    inner_radius = std::max(inner_radius, part.inner);
    count += part.count;
    if (out)
      out->intersect(part);
    else
      out = part;
  }
  if (missing || !out) return Extent::nothing();
  // An intersection (meet) with an empty operand has no shapes, and an operand may turn out empty, so no shape of it is
  // certain.
  out->certain = false;
  out->inner = inner_radius;
  out->inner_low = 0;
  out->count = std::max(1.0, count);
  out->node();
  return *out;
}

Extent boundSmooth(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  Extent e = boundStatement(s.body, frame, context);
  if (s.amount != kNoId) e.smooth(std::max(0.0, context.values.number(s.amount, frame).hi));
  return e;
}

Extent boundSum(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  Extent e = boundStatement(s.body, frame, context);
  e.summed();
  return e;
}

/// Returns the extent of the body of a snap or a detail. Also evaluates the statement's own expressions, so that
/// queries in them are recorded.
Extent boundWithQueries(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  context.values.number(s.expr, frame);
  if (s.amount != kNoId) context.values.number(s.amount, frame);
  return boundStatement(s.body, frame, context);
}

Extent boundMorph(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  Extent a = boundStatement(context.program.idAt(s.children, 0), frame, context);
  const Extent b = boundStatement(context.program.idAt(s.children, 1), frame, context);
  bool apart = false;
  for (size_t i = 0; i < 3 && !a.empty && !b.empty; ++i)
    apart = apart || a.at.may[i].hi < b.at.may[i].lo || b.at.may[i].hi < a.at.may[i].lo;
  if (apart && !context.pieces.isDividing())
    context.sink.warning(s.span, codes::kMorphDisjoint,
                         "the two shapes of this morph lie apart, and may vanish half way", "let them overlap");
  // A blend of two shapes always contains their intersection. No point outside of the intersection is certainly solid.
  std::array<double, 3> lo = a.sure_lo, hi = a.sure_hi;
  for (size_t i = 0; i < 3; ++i) {
    lo[i] = std::max(lo[i], b.sure_lo[i]);
    hi[i] = std::min(hi[i], b.sure_hi[i]);
  }
  const bool both = a.certain && b.certain;
  const double inner_low = std::min(a.inner_low, b.inner_low);
  a.join(b);
  a.sure_lo = lo;
  a.sure_hi = hi;
  a.certain = both;
  a.inner_low = inner_low;
  if (s.power && !a.empty) {
    // A morph by exponent is a superquadric. Its radii lie between the radii of the two shapes.
    const double least = inner_low > 0 ? 1 / inner_low : kInfinity;
    a.at.core = a.at.may;
    a.at.ball = 0;
    a.at.core_radius = anyDirection(a.at.may)[0].hi;
    a.spread = std::max(1.0, a.size() * least);
    a.turned_spread = std::max(1.0, a.at.core_radius * least);
  }
  a.count = std::max(1.0, a.count);
  a.node();
  return a;
}

Extent boundDisplace(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  Interval by = context.values.number(s.expr, frame);
  if (s.amount != kNoId) {
    const double most = context.values.number(s.amount, frame).magnitude();
    by = minimum(maximum(by, {-most, -most}), {most, most});
  }
  Extent e = boundStatement(s.body, frame, context);
  const Unbound before = e.why;
  // A positive displacement makes the shape smaller, a negative one makes it larger.
  e.shrinkSure(by.magnitude() * (std::isfinite(e.spread) ? e.spread : 1));
  e.grow(std::max(0.0, -by.lo));
  e.node();
  if ((!std::isfinite(by.lo) || e.why != before) && !e.empty) {
    e.largest_contributor = s.expr;
    e.contributor_size = kInfinity;
  }
  return e;
}

Extent boundWarp(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  IntervalVector by = context.values.vector(s.expr, frame);
  double most = kInfinity, largest = 0;
  if (s.amount != kNoId) most = context.values.number(s.amount, frame).magnitude();
  for (Interval& part : by) {
    part = -minimum(maximum(part, {-most, -most}), {most, most});
    largest = std::max(largest, part.magnitude());
  }
  Extent e = boundStatement(s.body, frame, context);
  e.add(by);
  e.node();
  e.shrinkSure(largest);
  if (!std::isfinite(largest) && !e.empty) {
    e.largest_contributor = s.expr;
    e.contributor_size = largest;
  }
  return e;
}

/// Dispatches by kind. There is no default case, so that the compiler reports a kind that is not handled.
Extent boundKind(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  switch (s.kind) {
    case StmtKind::block:
      return context.overrides.boundTagged(s, s.tag, frame, context);
    case StmtKind::call:
      return boundCall(s.expr, CallSite::statement, frame, context);
    case StmtKind::unite:
    case StmtKind::cut:
      return boundSmooth(s, frame, context);
    case StmtKind::meet:
    case StmtKind::extrude:
      return context.overrides.boundTagged(s, blockTag(s.body, context.program), frame, context);
    case StmtKind::sum:
      return boundSum(s, frame, context);
    case StmtKind::morph:
      return boundMorph(s, frame, context);
    case StmtKind::displace:
      return boundDisplace(s, frame, context);
    case StmtKind::warp:
      return boundWarp(s, frame, context);
    case StmtKind::transform:
      return boundTransform(s, frame, context);
    case StmtKind::repeat:
      return boundRepeat(s, frame, context);
    case StmtKind::for_each:
      return boundForEach(s, frame, context);
    case StmtKind::scatter:
      return boundScatter(s, frame, context);
    case StmtKind::split:
      return boundSplit(s, frame, context);
    case StmtKind::comp:
      return boundComp(s, frame, context);
    case StmtKind::treemap:
      return boundTreemap(s, frame, context);
    case StmtKind::wfc:
      return boundWfc(s, frame, context);
    case StmtKind::let:
      frame.slots[s.slot] = context.values.evaluate(s.expr, frame);
      return Extent::nothing();
    case StmtKind::snap:
    case StmtKind::detail:
      return boundWithQueries(s, frame, context);
    case StmtKind::footprint:
      frame.slots[s.slot] = evaluateFootprint(context.program.ast.footprints[s.extra], frame, context);
      return Extent::nothing();
    case StmtKind::roof:
      return boundRoof(s, frame, context);
    case StmtKind::fit:
      return boundFit(s, frame, context);
    case StmtKind::inner:
      return context.overrides.boundInner(s, frame, context);
    case StmtKind::field:
    case StmtKind::mat:
    case StmtKind::tag:
    case StmtKind::anchor:
    case StmtKind::link:
    case StmtKind::border:
      return Extent::nothing();
  }
  return Extent::unbounded();
}

}  // namespace

Extent boundStatement(StmtId id, RangeFrame& frame, ReachContext& context) {
  if (id == kNoId) return Extent::nothing();
  if (context.budget.cutAtLimit()) return Extent::unbounded();
  context.budget.enter();
  // Save the latest loss of a bound that the enclosing statement's own expressions (such as a position or a count) have
  // caused, and clear it. Then a loss that is found below belongs to this statement. The saved loss is put back at the
  // end.
  BoundLosses& losses = context.values.losses();
  const uint32_t around = losses.takeLatest();
  Extent e = boundKind(context.program.stmt(id), frame, context);
  const uint32_t loss = losses.takeLatest();
  if (e.loss == 0 && e.lost()) e.loss = loss;
  losses.restoreLatest(around);
  context.budget.leave();
  return e;
}

Extent boundUntagged(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  if (s.kind == StmtKind::extrude) return boundExtrude(s, frame, context);
  return s.kind == StmtKind::meet ? boundMeet(s, frame, context) : boundBlock(s, frame, context);
}

Extent boundBlock(const StmtNode& s, RangeFrame& frame, ReachContext& context, Extent first) {
  return boundRestOfBlock(s, 0, frame, context, std::move(first));
}

}  // namespace sgm::reach
