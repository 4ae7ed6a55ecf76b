#include "grammar/range/extent.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace sgm {

namespace {

constexpr double kSupport = 1.6;  ///< support of a sum's kernel, as a multiple of the inner radius (derive/shape.h)

double boxRadius(const IntervalVector& box) {
  double sum = 0;
  for (const Interval& side : box) sum += side.magnitude() * side.magnitude();
  return std::sqrt(sum) * (1 + 1e-12);
}

/// Returns the amplitude below which a displacement of a sum of at most `count` shapes stays bounded. Far from its
/// leaves, the sum's field has a constant value: the kernel's threshold divided by the kernel's slope at the largest
/// leaf. A larger displacement could make the field negative there, so that the shape would fill all space. The reserve
/// for rounding grows with the number of shapes, as in derive/bounds.cpp.
double sumLimit(double inner, double count) {
  constexpr double kInverse = 1 / (kSupport * kSupport), kBase = 1 - kInverse;
  const double left = kBase * kBase * kBase - 1e-6 * (count + 1);
  return left > 0 ? left * inner / (6 * kBase * kBase * kInverse) * (1 - 1e-6) : 0;
}

IntervalVector grown(const IntervalVector& box, double margin) {
  IntervalVector out = box;
  for (Interval& side : out) side = {side.lo - margin, side.hi + margin};
  return out;
}

}  // namespace

Interval scaleFactor(Interval written) {
  if (written.lo > 0 && written.bounded()) return written;
  return hull({std::max(0.0, written.lo), std::max(0.0, written.hi)}, {1, 1});
}

Hull Hull::everywhere() {
  Hull h;
  h.may.fill(Interval::everything());
  h.core = h.may;
  h.core_radius = kInfinity;
  return h;
}

void Hull::merge(const Hull& other) {
  // Both hulls are expressed with the smaller of the two ball radii: the core of the hull with the larger radius grows
  // by the difference.
  const double least = std::min(ball, other.ball);
  const IntervalVector mine = grown(core, ball - least), theirs = grown(other.core, other.ball - least);
  for (size_t i = 0; i < 3; ++i) {
    may[i] = hull(may[i], other.may[i]);
    core[i] = hull(mine[i], theirs[i]);
  }
  core_radius = std::max(core_radius + ball, other.core_radius + other.ball) - least;
  ball = least;
}

void Hull::grow(double margin, double turned_margin) {
  may = grown(may, margin);
  ball += turned_margin;
}

void Hull::add(const IntervalVector& by) {
  for (size_t i = 0; i < 3; ++i) {
    may[i] = may[i] + by[i];
    core[i] = core[i] + by[i];
  }
  core_radius = std::min(core_radius + boxRadius(by), boxRadius(core));
}

void Hull::rotate(int axis, Interval angle) {
  const Interval reach{-core_radius, core_radius};
  if (axis > 2) {
    core.fill(reach);
    may = grown(core, ball);
    return;
  }
  const Interval c = cosine(angle), s = sine(angle);
  const size_t a = static_cast<size_t>(axis + 1) % 3, b = static_cast<size_t>(axis + 2) % 3;
  const Interval x = core[a], y = core[b], along = may[static_cast<size_t>(axis)];
  auto within = [&](Interval v) { return Interval{std::max(v.lo, reach.lo), std::min(v.hi, reach.hi)}; };
  core[a] = within(c * x - s * y);
  core[b] = within(s * x + c * y);
  may = grown(core, ball);
  may[static_cast<size_t>(axis)] = along;  // a rotation does not change coordinates along its axis
}

void Hull::scale(Interval factor) {
  for (size_t i = 0; i < 3; ++i) {
    may[i] = may[i] * factor;
    core[i] = core[i] * factor;
  }
  core_radius = boundProduct(core_radius, factor.hi);
  ball = boundProduct(ball, factor.hi);
}

void Hull::mirror(size_t axis) {
  may[axis] = -may[axis];
  core[axis] = -core[axis];
}

Extent Extent::nothing() {
  Extent e;
  e.uncertain();
  return e;
}

Extent Extent::unbounded() {
  Extent e = nothing();
  e.empty = false;
  e.at = e.in_sum = Hull::everywhere();
  e.count = kInfinity;
  return e;
}

Extent Extent::leaf(const IntervalVector& lower, const IntervalVector& upper, double ball) {
  Extent e = nothing();
  e.empty = false;
  e.count = 1;
  e.at.ball = ball;
  for (size_t i = 0; i < 3; ++i) {
    e.at.may[i] = {std::min(lower[i].lo, upper[i].lo), std::max(lower[i].hi, upper[i].hi)};
    e.at.core[i] = {e.at.may[i].lo + ball, e.at.may[i].hi - ball};
    // If the core is a single point, rounding may swap its ends.
    if (e.at.core[i].lo > e.at.core[i].hi) e.at.core[i] = Interval::exactly((e.at.may[i].lo + e.at.may[i].hi) / 2);
    e.sure_lo[i] = lower[i].hi;
    e.sure_hi[i] = upper[i].lo;
  }
  e.at.core_radius = boxRadius(e.at.core);
  e.in_sum = e.at;
  return e;
}

bool Extent::lost() const { return !empty && (why != Unbound::none || !std::isfinite(size())); }

double Extent::size() const {
  double out = 0;
  for (const Interval& side : at.may) out = std::max(out, side.magnitude());
  return empty ? 0 : out;
}

void Extent::attribute(ExprId call) {
  // For an unbounded extent, messages name the innermost call, where the bound is lost; for others, the call in the
  // layer's own rule.
  if (largest_contributor != kNoId && !std::isfinite(contributor_size)) return;
  largest_contributor = call;
  inside = kNoId;
  contributor_size = size();
}

void Extent::merge(const Extent& other) {
  at.merge(other.at);
  in_sum.merge(other.in_sum);
  for (size_t i = 0; i < 3; ++i) {
    sure_lo[i] = std::min(sure_lo[i], other.sure_lo[i]);
    sure_hi[i] = std::max(sure_hi[i], other.sure_hi[i]);
  }
  spread = std::max(spread, other.spread);
  turned_spread = std::max(turned_spread, other.turned_spread);
  limit = std::min(limit, other.limit);
  inner = std::max(inner, other.inner);
  if (why == Unbound::none) why = other.why, allowed = other.allowed;
  if (loss == 0) loss = other.loss;
  if (other.contributor_size > contributor_size) {
    largest_contributor = other.largest_contributor;
    override_id = other.override_id;
    inside = other.inside;
    contributor_size = other.contributor_size;
  }
}

void Extent::join(const Extent& other) {
  if (other.empty) return;
  if (empty) {
    *this = other;
    return;
  }
  inner_low = certain && other.certain ? std::max(inner_low, other.inner_low)
              : certain                ? inner_low
              : other.certain          ? other.inner_low
                                       : std::min(inner_low, other.inner_low);
  certain = certain || other.certain;
  count += other.count;
  merge(other);
}

void Extent::either(const Extent& other) {
  if (other.empty || empty) {
    if (empty) *this = other;
    certain = false;
    return;
  }
  inner_low = std::min(inner_low, other.inner_low);
  certain = certain && other.certain;
  count = std::max(count, other.count);
  merge(other);
}

void addAlternative(std::optional<Extent>& all, const Extent& one) {
  if (all)
    all->either(one);
  else
    all = one;
}

void Extent::intersect(const Extent& other) {
  if (other.empty) *this = nothing();
  if (empty) return;
  if (loss == 0) loss = other.loss;
  IntervalVector both;
  for (size_t i = 0; i < 3; ++i) {
    both[i] = {std::max(at.may[i].lo, other.at.may[i].lo), std::min(at.may[i].hi, other.at.may[i].hi)};
    // If the boxes of the operands are disjoint, the result is the gap between them, because a later displacement may
    // let the operands meet there.
    if (both[i].lo > both[i].hi) both[i] = {both[i].hi, both[i].lo};
  }
  // For rotated scopes, the cores of the two operands cannot be intersected, so the smaller of the two hulls is used.
  if (other.at.core_radius + other.at.ball < at.core_radius + at.ball) {
    at = other.at;
    turned_spread = other.turned_spread;
  }
  at.may = both;
  spread = std::max(spread, other.spread);
  limit = std::min(limit, other.limit);
  if (why == Unbound::none) why = other.why, allowed = other.allowed;
  uncertain();
}

void Extent::loseBound(Unbound reason) {
  if (why == Unbound::none) {
    why = reason;
    allowed = limit;
  }
  at = in_sum = Hull::everywhere();
}

void Extent::grow(double margin) {
  if (empty || !(margin > 0)) return;
  if (margin >= limit) return loseBound(Unbound::sum);
  if (!std::isfinite(spread * margin) && std::isfinite(margin)) return loseBound(Unbound::radius);
  at.grow(boundProduct(margin, spread), boundProduct(margin, turned_spread));
  if (std::isfinite(limit)) limit -= margin;
}

void Extent::smooth(double radius) {
  // A limit beyond the blend radius stays as it is: where both operands are farther away than the radius, a smooth
  // union equals a sharp one.
  const double before = limit;
  grow(radius);
  if (radius < before) limit = before;
  node();
}

void Extent::node() {
  if (empty) return;
  in_sum = at;
  const double margin = (kSupport - 1) * inner;
  if (margin > 0 && (margin >= limit || !std::isfinite(margin * spread)))
    in_sum = Hull::everywhere();
  else
    in_sum.grow(boundProduct(margin, spread), boundProduct(margin, turned_spread));
}

void Extent::add(const IntervalVector& by) {
  if (empty) return;
  at.add(by);
  in_sum.add(by);
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
  add(by);
  for (size_t i = 0; i < 3; ++i) {
    sure_lo[i] += by[i].hi;
    sure_hi[i] += by[i].lo;
    if (std::isnan(sure_lo[i])) sure_lo[i] = kInfinity;
    if (std::isnan(sure_hi[i])) sure_hi[i] = -kInfinity;
  }
}

void Extent::rotate(int axis, Interval angle) {
  if (empty || angle == Interval{}) return;
  uncertain();
  spread = turned_spread;
  at.rotate(axis, angle);
  in_sum.rotate(axis, angle);
}

void Extent::scale(Interval written) {
  if (empty) return;
  const Interval factor = scaleFactor(written);
  at.scale(factor);
  in_sum.scale(factor);
  for (size_t i = 0; i < 3 && factor.bounded(); ++i) {
    sure_lo[i] = std::isfinite(sure_lo[i]) ? (Interval::exactly(sure_lo[i]) * factor).hi : sure_lo[i];
    sure_hi[i] = std::isfinite(sure_hi[i]) ? (Interval::exactly(sure_hi[i]) * factor).lo : sure_hi[i];
  }
  inner = boundProduct(inner, factor.hi);
  inner_low *= factor.lo;
  if (std::isfinite(limit)) limit *= factor.lo;
}

void Extent::mirror(int axis) {
  if (empty) return;
  const size_t i = static_cast<size_t>(axis);
  at.mirror(i);
  in_sum.mirror(i);
  const double lo = sure_lo[i];
  sure_lo[i] = -sure_hi[i];
  sure_hi[i] = -lo;
}

void Extent::repeat(Interval times) {
  count = boundProduct(count, std::max(0.0, times.hi));
  if (times.lo < 1) certain = false;
}

void Extent::summed() {
  if (empty) return;
  at = in_sum;
  // `at` now bounds the kernels. Below the limit, the level sets of a sum do not extend beyond its kernels.
  spread = turned_spread = 0;
  limit = sumLimit(inner_low, count);
  count = 1;
  node();
}

}  // namespace sgm
