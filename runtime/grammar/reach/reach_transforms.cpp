#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/reach/reach_check.h"

namespace sgm {

namespace {

/// Counts and the ends of loops are rounded to the nearest whole number.
Interval rounded(Interval v) { return floorOf({v.lo + 0.5, v.hi + 0.5}); }

/// The most copies that are followed one by one if each one's size depends on the previous one's.
constexpr double kSizedCopies = 64;

/// A power of a scale, with room for the rounding of the product that it replaces.
Interval powerOf(Interval base, double times) {
  if (times == 0 || base == Interval{1, 1}) return {1, 1};
  const double low = base.lo > 0 ? detPow(base.lo, times) : 0, high = base.hi > 0 ? detPow(base.hi, times) : 0;
  return {low * (1 - 1e-9), std::isnan(high) ? kInfinity : high * (1 + 1e-9)};
}

}  // namespace

IntervalVector ReachCheck::pointOf(const XformNode& x, const RangeFrame& frame) {
  const RangeValue first = values_.evaluate(x.a, frame);
  if (first.kind == ValueKind::vector) return first.v;
  auto part = [&](ExprId id) { return id == kNoId ? Interval{} : values_.number(id, frame); };
  return {part(x.a), part(x.b), part(x.c)};
}

void ReachCheck::sized(const XformNode& x, RangeFrame& frame) {
  const RangeValue first = values_.evaluate(x.a, frame);
  const ExprId parts[3] = {x.a, x.b, x.c};
  IntervalVector scope = frame.scope;
  for (size_t axis = 0; axis < 3; ++axis) {
    if (first.kind == ValueKind::vector)
      scope[axis] = first.v[axis];
    else if (parts[axis] != kNoId)
      scope[axis] = values_.number(parts[axis], frame);
  }
  frame.scope = scope;
}

Extent ReachCheck::transformed(const StmtNode& s, RangeFrame& frame) {
  struct Step {
    XformKind kind;
    int axis;
    IntervalVector by;
    Interval amount;
  };
  const IntervalVector scope = frame.scope;
  const PlaceRange place = frame.place;
  std::vector<Step> steps;
  for (uint32_t i = 0; i < s.xforms.count; ++i) {
    const XformNode& x = program_.ast.xforms[s.xforms.first + i];
    Step step{x.kind, x.axis, {}, {}};
    switch (x.kind) {
      case XformKind::at:
        step.by = pointOf(x, frame);
        frame.place.move(step.by);
        break;
      case XformKind::rot:
        step.amount = values_.number(x.b, frame);
        frame.place.turned = frame.place.turned || step.amount != Interval{};
        break;
      case XformKind::scale:
        step.amount = scaleFactor(values_.number(x.a, frame));
        frame.place.scale = frame.place.scale * step.amount;
        break;
      case XformKind::size:
        sized(x, frame);
        break;
      case XformKind::mirror:
        frame.place.turned = true;
        break;
    }
    steps.push_back(step);
  }
  Extent e = statement(s.body, frame);
  frame.scope = scope;
  frame.place = place;
  // The last written transform is the innermost.
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    if (step->kind == XformKind::at) e.move(step->by);
    if (step->kind == XformKind::rot) e.rotate(step->axis, step->amount);
    if (step->kind == XformKind::scale) e.scale(step->amount);
    if (step->kind == XformKind::mirror) e.mirror(step->axis);
  }
  return e;
}

/// The scopes of copies, each derived from the previous one: the first few one by one, and a range for all if that
/// suffices. times: upper bound of the copies after the first.
void ReachCheck::sizedAgain(IdRange xforms, double times, RangeFrame& frame) {
  const auto step = [&](const IntervalVector& scope) {
    RangeFrame next = frame;
    next.scope = scope;
    for (uint32_t i = 0; i < xforms.count; ++i) {
      const XformNode& x = program_.ast.xforms[xforms.first + i];
      if (x.kind == XformKind::size) sized(x, next);
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
    // Edges that only shrink approach 0.
    for (Interval& edge : all) edge.lo = std::min(edge.lo, 0.0);
    const IntervalVector next = step(all);
    for (size_t k = 0; k < 3; ++k)
      if (hull(all[k], next[k]) != all[k]) all[k] = Interval::everything();
  }
  frame.scope = all;
}

/// Copy i is at the end of i steps: exact if the steps only move, or only turn about one axis.
Extent ReachCheck::repeated(const StmtNode& s, RangeFrame& frame) {
  const Interval count = rounded(values_.number(s.expr, frame));
  if (!(count.hi >= 1)) return Extent::nothing();
  const Interval times{0, count.hi - 1};
  const IntervalVector scope = frame.scope;
  const PlaceRange place = frame.place;
  IntervalVector by{};
  Interval angle{}, scale{1, 1};
  int turns = 0, axis = 3, mirrors = 0, mirror = 0;
  if (times.hi > 0) sizedAgain(s.xforms, times.hi, frame);
  for (uint32_t i = 0; i < s.xforms.count && times.hi > 0; ++i) {
    const XformNode& x = program_.ast.xforms[s.xforms.first + i];
    switch (x.kind) {
      case XformKind::at: {
        const IntervalVector step = pointOf(x, frame);
        for (size_t k = 0; k < 3; ++k) by[k] = by[k] + step[k];
        break;
      }
      case XformKind::rot:
        angle = values_.number(x.b, frame) * times;
        axis = ++turns > 1 ? 3 : x.axis;
        break;
      case XformKind::scale:
        scale = scale * scaleFactor(values_.number(x.a, frame));
        break;
      case XformKind::mirror:
        ++mirrors;
        mirror = x.axis;
        break;
      case XformKind::size:
        break;
    }
  }
  const Interval grown = hull({1, 1}, powerOf(scale, times.hi));
  const bool turned = turns > 0 || mirrors > 0;
  if (turned || scale != Interval{1, 1}) by = anyDirection(stepLengths(s.xforms, frame));
  for (Interval& part : by) part = part * times * Interval::exactly(grown.hi);
  frame.place.move(by);
  frame.place.scale = frame.place.scale * grown;
  frame.place.turned = frame.place.turned || turned;
  Extent e = body(s.body, frame);
  frame.scope = scope;
  frame.place = place;
  e.repeat(count);
  if (times.hi == 0) return e;
  e.scale(grown);
  if (mirrors > 0) {
    Extent other = e;
    other.mirror(mirror);
    const double shapes = e.count;
    e.join(other);
    e.count = shapes;
  }
  if (turns > 0 || mirrors > 1) e.rotate(turns > 1 || mirrors > 0 ? 3 : axis, turns > 0 ? angle : Interval{-4, 4});
  if (turns > 1) e.rotate(3, {-4, 4});
  e.move(by);
  return e;
}

/// The total lengths of one step's moves, along each axis.
IntervalVector ReachCheck::stepLengths(IdRange xforms, const RangeFrame& frame) {
  double sum = 0;
  for (uint32_t i = 0; i < xforms.count; ++i) {
    const XformNode& x = program_.ast.xforms[xforms.first + i];
    if (x.kind == XformKind::at) sum += anyDirection(pointOf(x, frame))[0].hi;
  }
  return {Interval{-sum, sum}, Interval{}, Interval{}};
}

Extent ReachCheck::forEach(const StmtNode& s, RangeFrame& frame) {
  const ExprNode& source = program_.expr(s.expr);
  RangeValue variable = RangeValue::unknown();
  Interval times{0, 3};  // a cell owns at most three faces
  if (source.kind == ExprKind::range) {
    const Interval low = rounded(values_.number(program_.idAt(source.children, 0), frame));
    const Interval high = rounded(values_.number(program_.idAt(source.children, 1), frame));
    if (!(low.lo <= high.hi - 1)) return Extent::nothing();
    variable = RangeValue::number({low.lo, high.hi - 1});
    times = {std::max(0.0, high.lo - low.hi), high.hi - low.lo};
  } else {
    variable = values_.evaluate(s.expr, frame);
    const bool branch = variable.kind == ValueKind::segments;
    variable.kind = branch ? ValueKind::segment : ValueKind::face;
    if (branch) times.hi = kMostSegments;
  }
  frame.slots[s.slot] = variable;
  Extent e = pieces_ != Pieces::none && hasPieces(variable)
                 ? overPieces({&frame.slots[s.slot]}, [&] { return body(s.body, frame); })
                 : body(s.body, frame);
  e.repeat(times);
  return e;
}

IntervalVector ReachCheck::areaOf(const ScatterNode& scatter, const RangeFrame& frame) {
  IntervalVector at{};
  auto edge = [](Interval length) {
    const double half = length.magnitude() / 2;
    return Interval{-half, half};
  };
  switch (scatter.area) {
    case ScatterArea::cell:
      for (size_t i = 0; i < 3; ++i) at[i] = centred_ ? edge(cell_[i]) : Interval{0, cell_[i].hi};
      break;
    case ScatterArea::shell: {
      const Interval r = values_.number(scatter.a, frame);
      at.fill({-r.magnitude(), r.magnitude()});
      // The upper share of a sphere, by height.
      if (scatter.b != kNoId)
        at[1] = r * Interval{1 - 2 * std::clamp(values_.number(scatter.b, frame).hi, 0.0, 1.0), 1};
      break;
    }
    case ScatterArea::disc: {
      const Interval r = values_.number(scatter.a, frame);
      at[0] = at[2] = {-r.magnitude(), r.magnitude()};
      break;
    }
    case ScatterArea::box: {
      const RangeValue first = values_.evaluate(scatter.a, frame);
      if (first.kind == ValueKind::vector) return {edge(first.v[0]), edge(first.v[1]), edge(first.v[2])};
      const ExprId edges[3] = {scatter.a, scatter.b, scatter.c};
      for (size_t i = 0; i < 3; ++i) at[i] = edge(values_.number(edges[i], frame));
      break;
    }
  }
  return at;
}

Extent ReachCheck::scattered(const StmtNode& s, RangeFrame& frame) {
  const ScatterNode& scatter = program_.ast.scatters[s.extra];
  const IntervalVector drawn = areaOf(scatter, frame);
  IntervalVector at = drawn;
  if (scatter.probe != 0) {
    const double far = std::max(0.0, values_.number(scatter.distance, frame).hi);
    at[1] = scatter.probe > 0 ? at[1] + Interval{0, far} : at[1] + Interval{-far, 0};
  }
  if (scatter.gap != kNoId) {
    frame.slots[scatter.slot] = RangeValue::number({0, std::max(0.0, values_.number(scatter.within, frame).hi)});
  }
  const PlaceRange place = frame.place;
  if (scatter.when != kNoId) {
    frame.place.move(drawn);
    values_.condition(scatter.when, frame);
    frame.place = place;
  }
  frame.place.move(at);
  Extent e = body(s.body, frame);
  frame.place = place;
  Interval times{0, kInfinity};
  const Interval count = values_.number(scatter.count, frame);
  if (!scatter.poisson) times = rounded(count);
  if (scatter.when != kNoId || scatter.probe != 0) times.lo = 0;
  e.repeat(times);
  e.move(at);
  return e;
}

}  // namespace sgm
