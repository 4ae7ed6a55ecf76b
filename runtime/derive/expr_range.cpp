#include "derive/expr_range.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace sgm {
namespace {

constexpr Range kEverything{-kInfinity, kInfinity};

Range multiplied(Range a, Range b) {
  const double corner[4] = {boundProduct(a.lo, b.lo), boundProduct(a.lo, b.hi), boundProduct(a.hi, b.lo),
                            boundProduct(a.hi, b.hi)};
  return {*std::min_element(corner, corner + 4), *std::max_element(corner, corner + 4)};
}

Range divided(Range a, Range b) {
  if (b.lo <= 0 && b.hi >= 0) return kEverything;
  return multiplied(a, {std::isinf(b.hi) ? 0.0 : 1.0 / b.hi, std::isinf(b.lo) ? 0.0 : 1.0 / b.lo});
}

Range coordinateRange(const Expr& e, const IntBox* box) {
  Range sum;
  for (int axis = 0; axis < 3; ++axis) {
    const double row = static_cast<double>(e.row[static_cast<size_t>(axis)]) / kUnitsPerMetre;
    if (row == 0) continue;
    if (box == nullptr) return kEverything;
    const double lo = row * (static_cast<double>(box->lo[axis]) - e.anchor[axis]);
    const double hi = row * (static_cast<double>(box->hi[axis]) - e.anchor[axis]);
    sum = {sum.lo + std::min(lo, hi), sum.hi + std::max(lo, hi)};
  }
  return sum;
}

/// Widens a range by the rounding error of one float operation of the field. It also covers division, square root and
/// noise, which the field implements itself. Integer ends stay unchanged: integers are exact in float and rounding
/// never crosses one, so conditions stay 0 or 1.
Range widened(Range r) {
  const auto slack = [](double v) {
    const bool whole = std::fabs(v) < 1e6 && v == std::floor(v);
    return std::isinf(v) || whole ? 0.0 : 1e-6 * std::fabs(v) + 1e-9;
  };
  return {r.lo - slack(r.lo), r.hi + slack(r.hi)};
}

/// Returns the range of smoothstep for values in `x`, between constant edges `low` and `high` in either order.
Range smoothstepRange(Range x, Range low, Range high) {
  if (low.lo != low.hi || high.lo != high.hi || low.lo == high.lo) return {0, 1};
  const auto at = [&](double v) {
    const double t = std::clamp((v - low.lo) / (high.lo - low.lo), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
  };
  const double a = at(x.lo), b = at(x.hi);
  return {std::max(0.0, std::min(a, b) - 1e-6), std::min(1.0, std::max(a, b) + 1e-6)};
}

/// Returns the range of (1 - c) a + c b.
Range mixRange(Range a, Range b, Range c) {
  if (c.lo == 0 && c.hi == 0) return a;
  if (c.lo == 1 && c.hi == 1) return b;
  const Range step = multiplied({b.lo - a.hi, b.hi - a.lo}, c);
  const Range line{a.lo + step.lo, a.hi + step.hi};
  if (!(c.lo >= 0 && c.hi <= 1)) return line;
  // For c in 0..1 the value lies between a and b at every position, so it also lies in the hull of their ranges.
  return {std::max(line.lo, std::min(a.lo, b.lo)), std::min(line.hi, std::max(a.hi, b.hi))};
}

}  // namespace

std::vector<Range> exprRanges(std::span<const Expr> exprs, const IntBox* box) {
  std::vector<Range> ranges;
  ranges.reserve(exprs.size());
  const auto at = [&](uint32_t i) { return i < ranges.size() ? ranges[i] : kEverything; };
  for (const Expr& e : exprs) {
    const Range a = at(e.a), b = at(e.b), c = at(e.c);
    Range r = kEverything;
    switch (e.op) {
      case ExprOp::constant:
        ranges.push_back({static_cast<double>(e.value), static_cast<double>(e.value)});
        continue;
      case ExprOp::coordinate:
        r = coordinateRange(e, box);
        break;
      case ExprOp::noise:
        ranges.push_back({-1, 1});
        continue;
      case ExprOp::sweep:
        ranges.push_back({0, 1});
        continue;
      case ExprOp::smoothstep:
        ranges.push_back(smoothstepRange(a, b, c));
        continue;
      case ExprOp::less:
        ranges.push_back({a.hi < b.lo ? 1.0 : 0.0, a.lo >= b.hi ? 0.0 : 1.0});
        continue;
      case ExprOp::negate:
        r = {-a.hi, -a.lo};
        break;
      case ExprOp::absolute:
        r = {a.lo > 0 ? a.lo : a.hi < 0 ? -a.hi : 0.0, std::max(-a.lo, a.hi)};
        break;
      case ExprOp::floor:
        r = {std::floor(a.lo), std::floor(a.hi)};
        break;
      case ExprOp::square_root:
        r = {std::sqrt(std::max(a.lo, 0.0)), std::sqrt(std::max(a.hi, 0.0))};
        break;
      case ExprOp::add:
        r = {a.lo + b.lo, a.hi + b.hi};
        break;
      case ExprOp::subtract:
        r = {a.lo - b.hi, a.hi - b.lo};
        // For any a, the difference a - floor(a) lies in 0..1.
        if (e.b < ranges.size() && exprs[e.b].op == ExprOp::floor && exprs[e.b].a == e.a) r = {0, 1};
        break;
      case ExprOp::multiply:
        r = multiplied(a, b);
        break;
      case ExprOp::divide:
        r = divided(a, b);
        break;
      case ExprOp::minimum:
        ranges.push_back({std::min(a.lo, b.lo), std::min(a.hi, b.hi)});
        continue;
      case ExprOp::maximum:
        ranges.push_back({std::max(a.lo, b.lo), std::max(a.hi, b.hi)});
        continue;
      case ExprOp::mix:
        r = mixRange(a, b, c);
        break;
    }
    if (std::isnan(r.lo) || std::isnan(r.hi)) r = kEverything;
    ranges.push_back(widened(r));
  }
  return ranges;
}

IntBox warpedBox(std::span<const Expr> exprs, uint32_t offset, const IntBox& box) {
  const std::vector<Range> ranges = exprRanges(exprs, &box);
  const IntBox all = IntBox::everything();
  IntBox out;
  for (int axis = 0; axis < 3; ++axis) {
    const Range by = ranges[offset + static_cast<uint32_t>(axis)];
    // The margin of two units covers the rounding of positions to units.
    const double lo = std::floor(box.lo[axis] + by.lo * kUnitsPerMetre) - 2;
    const double hi = std::ceil(box.hi[axis] + by.hi * kUnitsPerMetre) + 2;
    out.lo[axis] = static_cast<int32_t>(std::max<double>(lo, all.lo[axis]));
    out.hi[axis] = static_cast<int32_t>(std::min<double>(hi, all.hi[axis]));
  }
  return out;
}

}  // namespace sgm
