#pragma once
// Arithmetic on intervals, for bounds of ops (interval.h).

#include <algorithm>
#include <cmath>

#include "field/interval.h"

namespace sgm {

inline constexpr double kLimit = 1e37;  ///< maximum magnitude of the ends of all intervals
inline constexpr double kHeld = 1e18;   ///< results of expressions are clamped to this magnitude (real.h, settleReal)
inline constexpr double kTiny = 1e-30;  ///< results of expressions with a magnitude below this are 0

/// Returns the relative error that ops.def states for the op.
constexpr double errorOf(Op op) {
  switch (op) {
#define SGM_OP(name, function, form, error) \
  case Op::name:                            \
    return error;
#include "field/ops.def"
#undef SGM_OP
    case Op::count:
      break;
  }
  return 0;
}

inline double magnitude(FloatInterval a) { return std::max(std::abs(a.lo), std::abs(a.hi)); }

inline FloatInterval held(double lo, double hi) {
  return {std::clamp(lo, -kLimit, kLimit), std::clamp(hi, -kLimit, kLimit)};
}

inline FloatInterval widened(FloatInterval a, double by) { return held(a.lo - by - kTiny, a.hi + by + kTiny); }

inline FloatInterval product(FloatInterval a, FloatInterval b) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  return held(std::min({p, q, r, s}), std::max({p, q, r, s}));
}

inline FloatInterval clamped(FloatInterval a, double lo, double hi) {
  return {std::clamp(a.lo, lo, hi), std::clamp(a.hi, lo, hi)};
}

inline FloatInterval kept(FloatInterval a) { return clamped(a, -kHeld, kHeld); }

/// Returns the offsets of positions from c along one axis, clamped to the range of an int32 as in the evaluators. A
/// clamped offset never changes faster than the position, so bounds that are derived from slopes hold at any distance.
inline FloatInterval offsets(FloatInterval axis, double c) {
  return clamped({axis.lo - c, axis.hi - c}, -2147483648.0, 2147483647.0);
}

inline FloatInterval squared(FloatInterval a) {
  const double l = a.lo * a.lo, h = a.hi * a.hi;
  return {a.lo <= 0 && a.hi >= 0 ? 0.0 : std::min(l, h), std::max(l, h)};
}

/// Returns the range of (1 - t) a + t b, for all t, a and b of three intervals. The function is linear in each
/// variable, so the ends of the intervals suffice.
inline FloatInterval blend(FloatInterval a, FloatInterval b, FloatInterval t) {
  auto at = [&](double s) {
    const FloatInterval p = product(a, {1 - s, 1 - s}), q = product(b, {s, s});
    return held(p.lo + q.lo, p.hi + q.hi);
  };
  const FloatInterval p = at(t.lo), q = at(t.hi);
  return {std::min(p.lo, q.lo), std::max(p.hi, q.hi)};
}

/// Returns bounds of the compact kernel max(0, 1 - x)^3. They are exactly [0, 0] if the kernel is certainly 0, because
/// pruning may drop an operand that adds exactly 0.
inline FloatInterval kernelBounds(FloatInterval x, double error) {
  auto cube = [](double v) {
    const double k = std::max(0.0, 1 - v);
    return k * k * k;
  };
  const double slack = error * (1 + magnitude(x));
  const double lo = cube(x.hi + slack), hi = cube(std::max(0.0, x.lo - slack));
  return {std::max(0.0, lo - error), hi > 0 ? hi + error : 0.0};
}

}  // namespace sgm
