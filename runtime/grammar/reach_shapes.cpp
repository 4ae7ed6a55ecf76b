#include "grammar/reach_shapes.h"

#include <algorithm>
#include <cmath>

namespace sgm {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double boxRadius(const IntervalVector& box) {
  double sum = 0;
  for (const Interval& side : box) sum += side.magnitude() * side.magnitude();
  return std::sqrt(sum) * (1 + 1e-12);
}

}  // namespace

Extent Extent::nothing() {
  Extent e;
  e.sure_lo.fill(kInfinity);
  e.sure_hi.fill(-kInfinity);
  return e;
}

Extent Extent::unbounded() {
  Extent e = nothing();
  e.empty = false;
  e.may.fill(Interval::everything());
  e.radius = kInfinity;
  return e;
}

Extent Extent::leaf(const IntervalVector& lower, const IntervalVector& upper) {
  Extent e = nothing();
  e.empty = false;
  for (size_t i = 0; i < 3; ++i) {
    e.may[i] = {std::min(lower[i].lo, upper[i].lo), std::max(lower[i].hi, upper[i].hi)};
    e.sure_lo[i] = lower[i].hi;
    e.sure_hi[i] = upper[i].lo;
  }
  e.radius = boxRadius(e.may);
  return e;
}

double Extent::size() const {
  double out = 0;
  for (const Interval& side : may) out = std::max(out, side.magnitude());
  return empty ? 0 : out;
}

void Extent::blame(ExprId call) {
  // What has no bound at all is best shown where it starts, anything else where the layer's own rule calls it.
  if (culprit != kNoId && !std::isfinite(culprit_size)) return;
  culprit = call;
  culprit_size = size();
}

void Extent::join(const Extent& other) {
  if (other.empty) return;
  if (empty) {
    *this = other;
    return;
  }
  for (size_t i = 0; i < 3; ++i) {
    may[i] = hull(may[i], other.may[i]);
    sure_lo[i] = std::min(sure_lo[i], other.sure_lo[i]);
    sure_hi[i] = std::max(sure_hi[i], other.sure_hi[i]);
  }
  radius = std::max(radius, other.radius);
  inner = std::max(inner, other.inner);
  if (other.culprit_size > culprit_size) {
    culprit = other.culprit;
    culprit_size = other.culprit_size;
  }
}

void Extent::intersect(const Extent& other) {
  if (other.empty) *this = nothing();
  if (empty) return;
  for (size_t i = 0; i < 3; ++i) {
    may[i] = {std::max(may[i].lo, other.may[i].lo), std::min(may[i].hi, other.may[i].hi)};
    if (may[i].lo > may[i].hi) {
      *this = nothing();
      return;
    }
  }
  radius = std::min({radius, other.radius, boxRadius(may)});
  inner = std::max(inner, other.inner);
  uncertain();
}

void Extent::grow(double margin) {
  if (empty || margin == 0) return;
  for (Interval& side : may) side = {side.lo - margin, side.hi + margin};
  radius += margin;
}

void Extent::uncertain() {
  sure_lo.fill(kInfinity);
  sure_hi.fill(-kInfinity);
}

void Extent::shrinkSure(double margin) {
  for (double& v : sure_lo) v += margin;
  for (double& v : sure_hi) v -= margin;
}

void Extent::move(const IntervalVector& by) {
  if (empty) return;
  for (size_t i = 0; i < 3; ++i) {
    may[i] = may[i] + by[i];
    sure_lo[i] += by[i].hi;
    sure_hi[i] += by[i].lo;
    if (std::isnan(sure_lo[i])) sure_lo[i] = kInfinity;
    if (std::isnan(sure_hi[i])) sure_hi[i] = -kInfinity;
  }
  radius = std::min(radius + boxRadius(by), boxRadius(may));
}

void Extent::rotate(int axis, Interval angle) {
  if (empty || angle == Interval{}) return;
  uncertain();
  const Interval ball{-radius, radius};
  if (axis > 2) {
    may.fill(ball);
    return;
  }
  const Interval c = cosine(angle), s = sine(angle);
  const size_t a = static_cast<size_t>(axis + 1) % 3, b = static_cast<size_t>(axis + 2) % 3;
  const Interval x = may[a], y = may[b];
  auto within = [&](Interval v) { return Interval{std::max(v.lo, ball.lo), std::min(v.hi, ball.hi)}; };
  may[a] = within(c * x - s * y);
  may[b] = within(s * x + c * y);
  may[static_cast<size_t>(axis)] = within(may[static_cast<size_t>(axis)]);
}

void Extent::scale(Interval factor) {
  if (empty) return;
  for (size_t i = 0; i < 3; ++i) {
    may[i] = may[i] * factor;
    if (factor.lo < 0 || !factor.bounded()) continue;
    sure_lo[i] = std::isfinite(sure_lo[i]) ? (Interval::exactly(sure_lo[i]) * factor).hi : sure_lo[i];
    sure_hi[i] = std::isfinite(sure_hi[i]) ? (Interval::exactly(sure_hi[i]) * factor).lo : sure_hi[i];
  }
  if (factor.lo < 0) uncertain();
  radius *= factor.magnitude();
  inner *= factor.magnitude();
  if (std::isnan(radius)) radius = kInfinity;
}

void Extent::mirror(int axis) {
  if (empty) return;
  const size_t i = static_cast<size_t>(axis);
  may[i] = -may[i];
  const double lo = sure_lo[i];
  sure_lo[i] = -sure_hi[i];
  sure_hi[i] = -lo;
}

Extent primitiveExtent(const Program& program, const ExprNode& call, RangeEvaluator& values, const RangeFrame& frame) {
  auto arg = [&](uint32_t i) { return i < call.bound.count ? program.idAt(call.bound, i) : kNoId; };
  auto in = [&](uint32_t i) { return arg(i) == kNoId ? Interval{} : values.number(arg(i), frame); };
  const Interval half{0.5, 0.5}, zero{};
  // A size below zero is no size: derivation rejects it.
  auto positive = [](Interval v) { return Interval{std::max(v.lo, 0.0), std::max(v.hi, 0.0)}; };
  auto centred = [&](Interval x, Interval y, Interval z) {
    const IntervalVector upper{positive(x), positive(y), positive(z)};
    Extent e = Extent::leaf({-upper[0], -upper[1], -upper[2]}, upper);
    e.inner = std::min({upper[0].hi, upper[1].hi, upper[2].hi});
    return e;
  };
  auto around = [&](Interval r, Interval bend) {
    const IntervalVector a = values.vector(arg(0), frame), b = values.vector(arg(1), frame);
    IntervalVector lower, upper;
    for (size_t i = 0; i < 3; ++i) {
      lower[i] = minimum(a[i], b[i]) - r;
      upper[i] = maximum(a[i], b[i]) + r;
    }
    Extent e = Extent::leaf(lower, upper);
    e.inner = r.hi;
    e.grow(std::max(0.0, bend.hi));
    return e;
  };
  switch (static_cast<Primitive>(call.id)) {
    case Primitive::sphere:
    case Primitive::blob: {
      Extent e = centred(in(0), in(0), in(0));
      e.radius = std::max(0.0, in(0).hi);
      return e;
    }
    case Primitive::box:
    case Primitive::ellipsoid:
    case Primitive::superq: {
      const bool box = static_cast<Primitive>(call.id) == Primitive::box;
      const Interval factor = box ? half : Interval{1, 1};
      const RangeValue first = values.evaluate(arg(0), frame);
      if (first.kind == ValueKind::vector)
        return centred(first.v[0] * factor, first.v[1] * factor, first.v[2] * factor);
      const Interval x = in(0) * factor;
      if (arg(1) == kNoId) return centred(x, x, x);
      return centred(x, in(1) * factor, in(2) * factor);
    }
    case Primitive::cylinder:
      return centred(in(0), in(1) * half, in(0));
    case Primitive::truncone: {
      const Interval widest = maximum(positive(in(1)), positive(in(2)));
      return centred(widest, in(0) * half, widest);
    }
    case Primitive::torus: {
      const Interval ring = positive(in(0)) + positive(in(1));
      Extent e = centred(ring, in(1), ring);
      e.inner = positive(in(1)).hi;
      return e;
    }
    case Primitive::capsule:
      return around(positive(in(2)), zero);
    case Primitive::tube:
      return around(positive(in(2)), in(3));
    // The square section may stand on its edge: its half diagonal counts.
    case Primitive::beam: {
      Extent e = around(positive(in(2)), in(3));
      e.grow(positive(in(2)).hi * 0.4143);
      return e;
    }
    case Primitive::halfspace: {
      Extent e = Extent::unbounded();
      if (arg(0) != kNoId) e.may[1].hi = in(0).hi;
      if (arg(1) != kNoId) e.may[1].lo = in(1).lo;
      return e;
    }
    case Primitive::prism: {
      const Interval h = positive(in(0) * half);
      IntervalVector lower{Interval{kInfinity, kInfinity}, -h, Interval{kInfinity, kInfinity}};
      IntervalVector upper{Interval{-kInfinity, -kInfinity}, h, Interval{-kInfinity, -kInfinity}};
      for (uint32_t i = 1; i < call.bound.count; ++i) {
        const IntervalVector corner = values.vector(arg(i), frame);
        for (size_t axis : {size_t{0}, size_t{2}}) {
          lower[axis] = minimum(lower[axis], corner[axis == 0 ? 0 : 1]);
          upper[axis] = maximum(upper[axis], corner[axis == 0 ? 0 : 1]);
        }
      }
      Extent e = Extent::leaf(lower, upper);
      e.inner = std::min(h.hi, e.radius);
      return e;
    }
  }
  return Extent::unbounded();
}

}  // namespace sgm
