#include "field/interval.h"

#include <algorithm>
#include <cmath>

#include "field/interval_arithmetic.h"
#include "field/reference.h"

namespace sgm {

double statedError(Op op) { return errorOf(op); }

PositionBox positionBox(const IntBox& box) {
  auto axis = [](int32_t lo, int32_t hi) { return FloatInterval{static_cast<double>(lo), static_cast<double>(hi)}; };
  return {axis(box.lo.x, box.hi.x), axis(box.lo.y, box.hi.y), axis(box.lo.z, box.hi.z)};
}

FloatInterval boundOperands(Op op, const uint32_t* p, FloatInterval a, FloatInterval b, FloatInterval c) {
  const double error = errorOf(op);
  switch (op) {
    case Op::constant:
      return {realAt(p, 0), realAt(p, 0)};
    case Op::copy:
      return a;
    case Op::negate:
      return {-a.hi, -a.lo};
    case Op::absolute:
      return {a.lo <= 0 && a.hi >= 0 ? 0.0 : std::min(std::abs(a.lo), std::abs(a.hi)), magnitude(a)};
    case Op::floor: {
      const FloatInterval h = clamped(a, -1e9, 1e9);
      return {std::floor(h.lo), std::floor(h.hi)};
    }
    case Op::square_root: {
      const FloatInterval r{std::sqrt(std::max(a.lo, 0.0)), std::sqrt(std::max(a.hi, 0.0))};
      // The margin of 1e-15 covers the square roots of operands below 1e-30, which the evaluators treat as 0.
      return widened(r, error * r.hi + 1e-15);
    }
    case Op::add:
      return widened(kept({a.lo + b.lo, a.hi + b.hi}), error * (magnitude(a) + magnitude(b)));
    case Op::subtract:
      return widened(kept({a.lo - b.hi, a.hi - b.lo}), error * (magnitude(a) + magnitude(b)));
    case Op::multiply: {
      const FloatInterval x = kept(a), y = kept(b), r = kept(product(x, y));
      return widened(r, error * magnitude(r) + kTiny * (magnitude(x) + magnitude(y)));
    }
    case Op::divide: {
      if (b.lo <= 2 * kTiny && b.hi >= -2 * kTiny) return {-1.1 * kHeld, 1.1 * kHeld};
      const FloatInterval inv = kept({1 / b.hi, 1 / b.lo});
      const FloatInterval r = kept(product(kept(a), inv));
      return widened(r, error * magnitude(r) + kTiny * magnitude(inv) + 1 / kHeld);
    }
    case Op::less:
      return {a.hi < b.lo ? 1.0 : 0.0, a.lo < b.hi ? 1.0 : 0.0};
    case Op::smoothstep: {
      // The evaluators clamp t to 0..1 before they compute the polynomial, so t = 0 and t = 1 give exactly 0 and 1.
      const double inv = realAt(p, 1);
      const FloatInterval raw = product({a.lo - realAt(p, 0), a.hi - realAt(p, 0)}, {inv, inv});
      const FloatInterval t = widened(raw, error * std::abs(inv) * (magnitude(a) + std::abs(realAt(p, 0))));
      if (t.hi <= 0) return {0, 0};
      if (t.lo >= 1) return {1, 1};
      auto at = [](double x) {
        const double v = std::clamp(x, 0.0, 1.0);
        return v * v * (3 - 2 * v);
      };
      return {std::max(0.0, at(t.lo) - error), at(t.hi) + error};
    }
    case Op::mix: {
      const FloatInterval r = kept(blend(a, b, c));
      return widened(r, error * (magnitude(a) + magnitude(b)) * (1 + 2 * magnitude(c)));
    }
    case Op::morph: {
      const FloatInterval r = kept(blend(a, b, clamped(c, 0, 1)));
      return widened(r, error * (magnitude(a) + magnitude(b)));
    }
    case Op::minimum:
      return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
    case Op::maximum:
      return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
    case Op::cut:
      return {std::max(a.lo, -b.hi), std::max(a.hi, -b.lo)};
    case Op::displace:
      return widened(kept({a.lo + 1024 * b.lo, a.hi + 1024 * b.hi}), error * (magnitude(a) + 1024 * magnitude(b)));
    case Op::kernel: {
      auto at = [&](double d) { return std::clamp(1 + d * realAt(p, 0), 0.0, 1e9); };
      const double slack = error * (1 + magnitude(a) * realAt(p, 0));
      const double lo = std::max(0.0, at(a.lo) - slack), hi = at(a.hi) + slack;
      return kernelBounds({lo * lo * realAt(p, 1), hi * hi * realAt(p, 1)}, error);
    }
    default:
      return {-kLimit, kLimit};
  }
}

FloatInterval boundRoundShare(const uint32_t* p, FloatInterval d) {
  const double k = realAt(p, 0);
  const double lo = std::clamp(k - d.hi, 0.0, 1e9), hi = std::clamp(k - d.lo, 0.0, 1e9);
  return {lo * lo, hi * hi};
}

FloatInterval boundRoundEnd(const uint32_t* p, FloatInterval nearest, FloatInterval sum) {
  const double k = realAt(p, 0);
  const FloatInterval top{std::max(nearest.lo, k), std::max(nearest.hi, k)};
  const FloatInterval root{std::sqrt(sum.lo), std::sqrt(sum.hi)};
  return widened({top.lo - root.hi, top.hi - root.lo}, errorOf(Op::round_end) * (magnitude(top) + root.hi));
}

FloatInterval boundRoundUnion(FloatInterval a, FloatInterval b, double k) {
  // The round union is monotone in both operands, and never above the smaller operand.
  const FloatInterval nearest{std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
  const double u = std::clamp(k - a.lo, 0.0, 1e9), v = std::clamp(k - b.lo, 0.0, 1e9), root = std::sqrt(u * u + v * v);
  if (u == 0 || v == 0) return nearest;
  return {std::min(nearest.lo, widened({k - root, k - root}, errorOf(Op::round_end) * (k + root)).lo), nearest.hi};
}

FloatInterval boundRoundCut(FloatInterval a, FloatInterval b, double k) {
  const FloatInterval r = boundRoundUnion({-a.hi, -a.lo}, b, k);
  return {-r.hi, -r.lo};
}

FloatInterval boundSumEnd(const uint32_t* p, FloatInterval sum) {
  const double threshold = realAt(p, 0), length = realAt(p, 1);
  return widened(kept({(threshold - sum.hi) * length, (threshold - sum.lo) * length}),
                 errorOf(Op::sum_end) * (threshold + sum.hi) * length);
}

}  // namespace sgm
