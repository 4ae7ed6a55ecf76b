// Evaluates calls of built-in functions, and members of vectors, cells and faces, over intervals.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "grammar/range/reach_values.h"

namespace sgm {

namespace {

/// Widens an interval for functions with steps at whole numbers, such as floor: the field computes with floats, so a
/// value near a step may fall on either side.
Interval sampledFloats(Interval v) {
  auto whole = [](double x) { return x == std::floor(x) && std::fabs(x) < 1e6; };
  return {whole(v.lo) ? v.lo : v.lo - 1e-6 * std::fabs(v.lo) - 1e-9,
          whole(v.hi) ? v.hi : v.hi + 1e-6 * std::fabs(v.hi) + 1e-9};
}

}  // namespace

RangeValue RangeEvaluator::member(const ExprNode& n, const RangeFrame& frame) {
  const RangeValue of = evaluate(child(n, 0), frame);
  const bool place = of.kind == ValueKind::cell || of.kind == ValueKind::face;
  switch (n.member) {
    case Member::x:
    case Member::y:
    case Member::z:
      if (place || of.kind == ValueKind::unknown) return RangeValue::number(Interval::everything());
      return RangeValue::number(of.v[static_cast<size_t>(n.member) - static_cast<size_t>(Member::x)]);
    case Member::other: {
      RangeValue out{ValueKind::cell, of.v};
      for (size_t i = 0; i < 3; ++i) out.v[i] = of.v[i] + Interval{0, 1};
      return out;
    }
    case Member::axis:
      return RangeValue::number({0, 2});
    case Member::size:
      return RangeValue::vector(cell_);
    case Member::center: {
      if (!place) return RangeValue::unknown();
      // The centre of a face lies, along the face's axis, at the border between its two cells (1), and along the other
      // axes in the middle (0.5). The axis is unknown, so each axis gets both values.
      const Interval share = of.kind == ValueKind::face ? Interval{0.5, 1} : Interval{0.5, 0.5};
      return point({of.v[0] + share, of.v[1] + share, of.v[2] + share}, frame);
    }
    case Member::faces:
      return {ValueKind::faces, of.v};
    case Member::from:
    case Member::to:
      if (of.kind != ValueKind::segment) return RangeValue::unknown();
      return RangeValue::vector({of.v[0], of.v[0], of.v[0]});
    case Member::along:
      return RangeValue::number({0, 1});
    case Member::depth:
      return RangeValue::number(of.v[1]);
    default:
      return RangeValue::unknown();
  }
}

RangeValue RangeEvaluator::builtin(const ExprNode& n, const RangeFrame& frame) {
  const Builtin id = static_cast<Builtin>(n.id);
  auto arg = [&](uint32_t i) { return program_.idAt(n.bound, i); };
  auto in = [&](uint32_t i) { return number(arg(i), frame); };
  switch (id) {
    case Builtin::min:
      return RangeValue::number(minimum(in(0), in(1)));
    case Builtin::max:
      return RangeValue::number(maximum(in(0), in(1)));
    case Builtin::abs:
      return RangeValue::number(absolute(in(0)));
    case Builtin::floor:
      return RangeValue::number(floorOf(program_.expr(arg(0)).type.sample ? sampledFloats(in(0)) : in(0)));
    case Builtin::ceil:
      return RangeValue::number(-floorOf(-in(0)));
    case Builtin::sqrt:
      return RangeValue::number(squareRoot(in(0)));
    case Builtin::mix: {
      const Interval a = in(0), b = in(1), t = in(2);
      const Interval line = a + (b - a) * t, both = hull(a, b);
      // For t in 0..1 the result lies between a and b (`both`), however a and b are correlated. If t is known exactly,
      // `line` is tighter. So intersect both intervals.
      if (t.lo >= 0 && t.hi <= 1) return RangeValue::number({std::max(line.lo, both.lo), std::min(line.hi, both.hi)});
      return RangeValue::number(line);
    }
    case Builtin::clamp:
      return RangeValue::number(minimum(maximum(in(0), in(1)), in(2)));
    case Builtin::smoothstep:
      return RangeValue::number(smoothStep(in(0), in(1), in(2)));
    case Builtin::fract:
      in(0);  // the operand is evaluated only to record the queries in it
      return RangeValue::number({0, 1});
    case Builtin::sin:
      return RangeValue::number(sine(in(0)));
    case Builtin::cos:
      return RangeValue::number(cosine(in(0)));
    case Builtin::atan2:
      return RangeValue::number({-3.1415926535897936, 3.1415926535897936});
    case Builtin::pow:
      return RangeValue::number(power(in(0), in(1)));
    case Builtin::length: {
      const IntervalVector v = vector(arg(0), frame);
      Interval sum{};
      for (const Interval& part : v) sum = sum + absolute(part) * absolute(part);
      return RangeValue::number(squareRoot(sum));
    }
    case Builtin::rand:
      return RangeValue::number(hull(in(0), in(1)));
    case Builtin::rand_keyed:
      return RangeValue::number(hull(in(1), in(2)));
    case Builtin::chance: {
      const Interval p = in(0);
      return RangeValue::condition(p.lo >= 1 ? kTrue : p.hi <= 0 ? kFalse : kEither);
    }
    case Builtin::chance_keyed: {
      const Interval p = in(1);
      return RangeValue::condition(p.lo >= 1 ? kTrue : p.hi <= 0 ? kFalse : kEither);
    }
    case Builtin::cell_noise:
      return RangeValue::number({0, 1});
    case Builtin::fractal:
      in(0);
      return RangeValue::number({-1, 1});
    case Builtin::cell_point:
    case Builtin::face_point: {
      const RangeValue of = evaluate(arg(0), frame);
      if (of.kind != ValueKind::cell && of.kind != ValueKind::face) return RangeValue::unknown();
      Interval jitter = arg(1) == kNoId ? Interval{0.5, 0.5} : in(1);
      jitter = minimum(maximum(jitter, {0, 0}), {1, 1});
      const double half = jitter.hi / 2;
      Interval spread{0.5 - half, 0.5 + half};
      // A point of a face has the share 1 (the border between the face's two cells) along the face's axis. This axis is
      // not known here, so the interval of every axis is extended to 1.
      if (of.kind == ValueKind::face) spread.hi = 1;
      return point({of.v[0] + spread, of.v[1] + spread, of.v[2] + spread}, frame);
    }
    case Builtin::cell_links:
      return {ValueKind::faces, evaluate(arg(0), frame).v};
    case Builtin::position:
      return RangeValue::vector({in(0), in(1), in(2)});
    case Builtin::branch: {
      // The ends of the segments are at most as far away as all steps in a straight line, plus the rounding of each
      // step.
      const double steps = std::floor(std::clamp(in(0).hi + 0.5, 0.0, static_cast<double>(kMaxSegments)));
      const double far = boundProduct(steps, std::max(0.0, in(1).hi)) * (1 + 1e-9);
      return {ValueKind::segments, {Interval{-far, far}, Interval{0, std::max(0.0, steps - 1)}, Interval{}}, {}};
    }
  }
  return RangeValue::unknown();
}

RangeValue RangeEvaluator::point(const IntervalVector& cells, const RangeFrame& frame) {
  RangeValue out = RangeValue::vector(cells);
  for (size_t i = 0; i < 3; ++i) out.v[i] = (cells[i] + Interval::exactly(low_)) * cell_[i];
  dependence_.place = true;
  const PlaceRange& start = frame.start;
  if (start == PlaceRange{}) return out;
  for (size_t i = 0; i < 3; ++i) out.v[i] = out.v[i] - start.offset[i];
  if (start.turned) out.v = anyDirection(out.v);
  for (Interval& part : out.v) part = part / start.scale;
  return out;
}

}  // namespace sgm
