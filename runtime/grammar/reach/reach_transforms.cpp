// Computes extents of transforms, loops and point sets.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/reach/kept_scope.h"
#include "grammar/reach/reach_statements.h"

namespace sgm::reach {

namespace {

/// Rounds counts and the ends of loops to the nearest whole number, as derivation does.
Interval rounded(Interval v) { return floorOf({v.lo + 0.5, v.hi + 0.5}); }

/// Maximum number of copies of a repeat that are evaluated one by one if the size of each depends on the size of the
/// previous one.
constexpr double kSizedCopies = 64;

/// Returns a power of a scale factor, widened by the rounding errors of the repeated multiplication in derivation.
Interval raiseTo(Interval base, double times) {
  if (times == 0 || base == Interval{1, 1}) return {1, 1};
  const double low = base.lo > 0 ? detPow(base.lo, times) : 0, high = base.hi > 0 ? detPow(base.hi, times) : 0;
  return {low * (1 - 1e-9), std::isnan(high) ? kInfinity : high * (1 + 1e-9)};
}

/// Evaluates the vector by which an `at` moves the scope.
IntervalVector evaluatePoint(const XformNode& x, const RangeFrame& frame, ReachContext& context) {
  const RangeValue first = context.values.evaluate(x.a, frame);
  if (first.kind == ValueKind::vector) return first.v;
  auto part = [&](ExprId id) { return id == kNoId ? Interval{} : context.values.number(id, frame); };
  return {part(x.a), part(x.b), part(x.c)};
}

/// Sets the frame's scope to the scope that a `size` transform makes.
void applySize(const XformNode& x, RangeFrame& frame, ReachContext& context) {
  const RangeValue first = context.values.evaluate(x.a, frame);
  const ExprId parts[3] = {x.a, x.b, x.c};
  IntervalVector scope = frame.scope;
  for (size_t axis = 0; axis < 3; ++axis) {
    if (first.kind == ValueKind::vector)
      scope[axis] = first.v[axis];
    else if (parts[axis] != kNoId)
      scope[axis] = context.values.number(parts[axis], frame);
  }
  frame.scope = scope;
}

/// Sets the frame's scope to a range that contains the scopes of all copies of a repeat. The scope of each copy is
/// computed from the previous copy's scope, one by one for the first copies. If there are more copies, an edge becomes
/// unbounded if one further step would leave its range. times: upper bound of the number of copies after the first.
void applySizes(IdRange xforms, double times, RangeFrame& frame, ReachContext& context) {
  const auto step = [&](const IntervalVector& scope) {
    RangeFrame next = frame;
    next.scope = scope;
    for (uint32_t i = 0; i < xforms.count; ++i) {
      const XformNode& x = context.program.ast.xforms[xforms.first + i];
      if (x.kind == XformKind::size) applySize(x, next, context);
    }
    return next.scope;
  };
  const auto joined = [](const IntervalVector& a, const IntervalVector& b) {
    return IntervalVector{hull(a[0], b[0]), hull(a[1], b[1]), hull(a[2], b[2])};
  };
  IntervalVector all = frame.scope, last = frame.scope;
  for (int copy = 0; copy < std::min(times, kSizedCopies); ++copy) {
    last = step(last);
    all = joined(all, last);
    if (joined(all, step(all)) == all) times = 0;
  }
  if (times > kSizedCopies) {
    // Edges that shrink with each copy approach 0, so their range must include 0.
    for (Interval& edge : all) edge.lo = std::min(edge.lo, 0.0);
    const IntervalVector next = step(all);
    for (size_t k = 0; k < 3; ++k)
      if (hull(all[k], next[k]) != all[k]) all[k] = Interval::everything();
  }
  frame.scope = all;
}

/// Returns a vector along x, in either direction, that is at least as long as all moves in one step of a repeat
/// together. anyDirection() converts it to bounds for all directions.
IntervalVector boundStepLengths(IdRange xforms, const RangeFrame& frame, ReachContext& context) {
  double sum = 0;
  for (uint32_t i = 0; i < xforms.count; ++i) {
    const XformNode& x = context.program.ast.xforms[xforms.first + i];
    if (x.kind == XformKind::at) sum += anyDirection(evaluatePoint(x, frame, context))[0].hi;
  }
  return {Interval{-sum, sum}, Interval{}, Interval{}};
}

/// Returns a box that contains the points of a scatter, before probes move them.
IntervalVector boundArea(const ScatterNode& scatter, const RangeFrame& frame, ReachContext& context) {
  const IntervalVector& cell = context.cell.edges;
  IntervalVector at{};
  auto edge = [](Interval length) {
    const double half = length.magnitude() / 2;
    return Interval{-half, half};
  };
  switch (scatter.area) {
    case ScatterArea::cell:
      for (size_t i = 0; i < 3; ++i) at[i] = context.cell.centred ? edge(cell[i]) : Interval{0, cell[i].hi};
      break;
    case ScatterArea::shell: {
      const Interval r = context.values.number(scatter.a, frame);
      at.fill({-r.magnitude(), r.magnitude()});
      // The top fraction b of a sphere's area is the part above height r (1 - 2 b).
      if (scatter.b != kNoId)
        at[1] = r * Interval{1 - 2 * std::clamp(context.values.number(scatter.b, frame).hi, 0.0, 1.0), 1};
      break;
    }
    case ScatterArea::disc: {
      const Interval r = context.values.number(scatter.a, frame);
      at[0] = at[2] = {-r.magnitude(), r.magnitude()};
      break;
    }
    case ScatterArea::box: {
      const RangeValue first = context.values.evaluate(scatter.a, frame);
      if (first.kind == ValueKind::vector) return {edge(first.v[0]), edge(first.v[1]), edge(first.v[2])};
      const ExprId edges[3] = {scatter.a, scatter.b, scatter.c};
      for (size_t i = 0; i < 3; ++i) at[i] = edge(context.values.number(edges[i], frame));
      break;
    }
  }
  return at;
}

/// The combined transforms of one step of a repeat.
struct RepeatedStep {
  IntervalVector by{};
  Interval angle{}, scale{1, 1};
  int turns = 0, axis = 3, mirrors = 0, mirror = 0;
};

/// Evaluates the transforms of one step of a repeat. times: the range of the number of steps that lead to a copy, over
/// all copies.
RepeatedStep evaluateStep(IdRange xforms, Interval times, const RangeFrame& frame, ReachContext& context) {
  RepeatedStep out;
  for (uint32_t i = 0; i < xforms.count; ++i) {
    const XformNode& x = context.program.ast.xforms[xforms.first + i];
    switch (x.kind) {
      case XformKind::at: {
        const IntervalVector step = evaluatePoint(x, frame, context);
        for (size_t k = 0; k < 3; ++k) out.by[k] = out.by[k] + step[k];
        break;
      }
      case XformKind::rot:
        out.angle = context.values.number(x.b, frame) * times;
        out.axis = ++out.turns > 1 ? 3 : x.axis;
        break;
      case XformKind::scale:
        out.scale = out.scale * scaleFactor(context.values.number(x.a, frame));
        break;
      case XformKind::mirror:
        ++out.mirrors;
        out.mirror = x.axis;
        break;
      case XformKind::size:
        break;
    }
  }
  return out;
}

}  // namespace

Extent boundTransform(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  struct Step {
    XformKind kind;
    int axis;
    IntervalVector by;
    Interval amount;
  };
  const KeptScope kept(frame);
  std::vector<Step> steps;
  for (uint32_t i = 0; i < s.xforms.count; ++i) {
    const XformNode& x = context.program.ast.xforms[s.xforms.first + i];
    Step step{x.kind, x.axis, {}, {}};
    switch (x.kind) {
      case XformKind::at:
        step.by = evaluatePoint(x, frame, context);
        frame.place.move(step.by);
        break;
      case XformKind::rot:
        step.amount = context.values.number(x.b, frame);
        frame.place.turned = frame.place.turned || step.amount != Interval{};
        break;
      case XformKind::scale:
        step.amount = scaleFactor(context.values.number(x.a, frame));
        frame.place.scale = frame.place.scale * step.amount;
        break;
      case XformKind::size:
        applySize(x, frame, context);
        break;
      case XformKind::mirror:
        frame.place.turned = true;
        break;
    }
    steps.push_back(step);
  }
  Extent e = boundStatement(s.body, frame, context);
  // Applied in reverse order, since the last written transform is the innermost.
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    if (step->kind == XformKind::at) e.move(step->by);
    if (step->kind == XformKind::rot) e.rotate(step->axis, step->amount);
    if (step->kind == XformKind::scale) e.scale(step->amount);
    if (step->kind == XformKind::mirror) e.mirror(step->axis);
  }
  return e;
}

/// Returns the extent of a repeat, whose copy i results from i steps. The extent is exact if the steps only move, or
/// only rotate about one axis.
Extent boundRepeat(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  const Interval count = rounded(context.values.number(s.expr, frame));
  if (!(count.hi >= 1)) return Extent::nothing();
  const Interval times{0, count.hi - 1};
  const KeptScope kept(frame);
  RepeatedStep step;
  if (times.hi > 0) {
    applySizes(s.xforms, times.hi, frame, context);
    step = evaluateStep(s.xforms, times, frame, context);
  }
  const Interval grown = hull({1, 1}, raiseTo(step.scale, times.hi));
  const bool turned = step.turns > 0 || step.mirrors > 0;
  if (turned || step.scale != Interval{1, 1}) step.by = anyDirection(boundStepLengths(s.xforms, frame, context));
  for (Interval& part : step.by) part = part * times * Interval::exactly(grown.hi);
  frame.place.move(step.by);
  frame.place.scale = frame.place.scale * grown;
  frame.place.turned = frame.place.turned || turned;
  Extent e = boundStatement(s.body, frame, context);
  e.repeat(count);
  if (times.hi == 0) return e;
  e.scale(grown);
  if (step.mirrors > 0) {
    Extent other = e;
    other.mirror(step.mirror);
    const double shapes = e.count;
    e.join(other);
    e.count = shapes;
  }
  const int axis = step.turns > 1 || step.mirrors > 0 ? 3 : step.axis;
  if (step.turns > 0 || step.mirrors > 1) e.rotate(axis, step.turns > 0 ? step.angle : Interval{-4, 4});
  if (step.turns > 1) e.rotate(3, {-4, 4});
  e.move(step.by);
  return e;
}

Extent boundForEach(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  const ExprNode& source = context.program.expr(s.expr);
  RangeValue variable = RangeValue::unknown();
  Interval times{0, 3};  // a cell owns at most three faces
  if (source.kind == ExprKind::range) {
    const Interval low = rounded(context.values.number(context.program.idAt(source.children, 0), frame));
    const Interval high = rounded(context.values.number(context.program.idAt(source.children, 1), frame));
    if (!(low.lo <= high.hi - 1)) return Extent::nothing();
    variable = RangeValue::number({low.lo, high.hi - 1});
    times = {std::max(0.0, high.lo - low.hi), high.hi - low.lo};
  } else {
    variable = context.values.evaluate(s.expr, frame);
    const bool branch = variable.kind == ValueKind::segments;
    variable.kind = branch ? ValueKind::segment : ValueKind::face;
    if (branch) times.hi = kMaxSegments;
  }
  frame.slots[s.slot] = variable;
  const auto body = [&] { return boundStatement(s.body, frame, context); };
  const bool in_pieces = context.pieces.isDividing() && hasPieces(variable);
  Extent e = in_pieces ? context.pieces.boundOver({&frame.slots[s.slot]}, body, context.budget) : body();
  e.repeat(times);
  return e;
}

Extent boundScatter(const StmtNode& s, RangeFrame& frame, ReachContext& context) {
  const ScatterNode& scatter = context.program.ast.scatters[s.extra];
  const IntervalVector drawn = boundArea(scatter, frame, context);
  IntervalVector at = drawn;
  if (scatter.probe != 0) {
    const double far = std::max(0.0, context.values.number(scatter.distance, frame).hi);
    at[1] = scatter.probe > 0 ? at[1] + Interval{0, far} : at[1] + Interval{-far, 0};
  }
  if (scatter.gap != kNoId) {
    frame.slots[scatter.slot] = RangeValue::number({0, std::max(0.0, context.values.number(scatter.within, frame).hi)});
  }
  const PlaceRange place = frame.place;
  if (scatter.when != kNoId) {
    frame.place.move(drawn);
    context.values.condition(scatter.when, frame);
    frame.place = place;
  }
  frame.place.move(at);
  Extent e = boundStatement(s.body, frame, context);
  frame.place = place;
  Interval times{0, kInfinity};
  const Interval count = context.values.number(scatter.count, frame);
  if (!scatter.poisson) times = rounded(count);
  if (scatter.when != kNoId || scatter.probe != 0) times.lo = 0;
  e.repeat(times);
  e.move(at);
  return e;
}

}  // namespace sgm::reach
