#include "derive/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math.h"

namespace sgm {
namespace {

/// A box in double precision, units; sides may be infinite.
struct WideBox {
  std::array<double, 3> lo{kInfinity, kInfinity, kInfinity};
  std::array<double, 3> hi{-kInfinity, -kInfinity, -kInfinity};

  static WideBox everything() { return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}; }
  bool empty() const { return lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2]; }
  void join(const WideBox& b) {
    if (b.empty()) return;
    for (size_t i = 0; i < 3; ++i) lo[i] = std::min(lo[i], b.lo[i]), hi[i] = std::max(hi[i], b.hi[i]);
  }
  void clip(const WideBox& b) {
    for (size_t i = 0; i < 3; ++i) lo[i] = std::max(lo[i], b.lo[i]), hi[i] = std::min(hi[i], b.hi[i]);
  }
};

double wide(float v) { return static_cast<double>(v); }

/// Returns a margin in units that covers the float rounding errors of the field, for lengths of up to `size` units.
double slack(double size) { return 1.0 + 1e-6 * std::fabs(size); }

/// Returns the axis-aligned world box around a box in the frame's local coordinates. centre, half: centre and half
/// extents of the local box, units.
WideBox placed(const Frame& frame, std::array<double, 3> centre, std::array<double, 3> half) {
  WideBox box;
  double reach = 0;
  for (size_t i = 0; i < 3; ++i) {
    if (!(half[i] >= 0)) return {};
    reach += half[i] + std::fabs(centre[i]);
  }
  if (std::isinf(reach)) return WideBox::everything();
  for (size_t j = 0; j < 3; ++j) {
    double at = frame.origin[static_cast<int>(j)], extent = slack(reach);
    for (size_t i = 0; i < 3; ++i) {
      const double row = wide(frame.rows[3 * i + j]);
      at += row * centre[i];
      extent += std::fabs(row) * half[i];
    }
    box.lo[j] = at - extent;
    box.hi[j] = at + extent;
  }
  return box;
}

WideBox placed(const Frame& frame, double x, double y, double z) { return placed(frame, {0, 0, 0}, {x, y, z}); }

/// Returns bounds of all points whose signed distance from a shape is at most `a` units, given the shape's local box.
/// For a > 0 the box grows by `a` in world axes, so the result is valid for any rotation; otherwise the half extents
/// shrink.
WideBox distance(const Frame& frame, std::array<double, 3> centre, std::array<double, 3> half, double a) {
  if (a <= 0) return placed(frame, centre, {half[0] + a, half[1] + a, half[2] + a});
  WideBox box = placed(frame, centre, half);
  if (box.empty()) return box;
  for (size_t i = 0; i < 3; ++i) box.lo[i] -= a + slack(a), box.hi[i] += a + slack(a);
  return box;
}

/// Returns bounds of the region where (norm(q / r) - 1) * min(r) <= a, for the local point q and the radii r. most:
/// upper bounds of the radii; least: lower bound of the smallest radius.
WideBox scaledRadii(const Frame& frame, std::array<double, 3> most, double least, double a) {
  if (!(least > 0)) return WideBox::everything();
  // For a negative `a` the region lies inside the surface (the zero level set), so the box need not grow.
  const double factor = 1.0 + std::max(a, 0.0) / least;
  return placed(frame, most[0] * factor, most[1] * factor, most[2] * factor);
}

/// Same as scaledRadii(), but with a smaller box for an ellipsoid, which does not fill the corners of its box.
WideBox ellipsoid(const Frame& frame, std::array<double, 3> radii, double a) {
  const double least = *std::min_element(radii.begin(), radii.end());
  if (!(least > 0)) return WideBox::everything();
  const double factor = 1.0 + std::max(a, 0.0) / least;
  WideBox box;
  for (size_t j = 0; j < 3; ++j) {
    double square = 0;
    for (size_t i = 0; i < 3; ++i) {
      const double along = wide(frame.rows[3 * i + j]) * radii[i];
      square += along * along;
    }
    const double half = std::sqrt(square) * factor, at = frame.origin[static_cast<int>(j)];
    box.lo[j] = at - half - slack(half);
    box.hi[j] = at + half + slack(half);
  }
  return box;
}

WideBox halfspace(const Frame& frame, double a) {
  WideBox box = WideBox::everything();
  for (size_t j = 0; j < 3; ++j) {
    const float row = frame.rows[3 + j];
    if (std::fabs(row) != 1.0f || frame.rows[3 + (j + 1) % 3] != 0.0f || frame.rows[3 + (j + 2) % 3] != 0.0f) continue;
    const double at = frame.origin[static_cast<int>(j)];
    if (row > 0) {
      box.hi[j] = at + a + slack(a);
    } else {
      box.lo[j] = at - a - slack(a);
    }
  }
  return box;
}

/// Returns a bound v for a `sum` of n leaves: at every point where the field of the sum is at most `a` units, at least
/// one leaf has a normalised distance 1 + d / r of at most v (d: distance to the leaf, r: its inner radius). A negative
/// v means that there is no such point.
double kernelReach(double inner_radius_max, size_t n, double a) {
  const double inverse = 1.0 / (wide(kSumSupport) * wide(kSumSupport));
  const double base = 1.0 - inverse;
  const double threshold = base * base * base;
  const double slope = 6.0 * base * base * inverse / inner_radius_max;
  // The subtracted term covers the rounding errors of adding n kernels in float.
  const double needed = (threshold - a * slope) - 1e-6 * static_cast<double>(n + 1);
  if (needed <= 0) return kInfinity;
  const double share = needed / static_cast<double>(n);
  if (share > 1) return -1;
  const double root = detPow(share, 1.0 / 3.0) * (1 - 1e-9);
  return wide(kSumSupport) * std::sqrt(std::max(0.0, 1.0 - root)) + 1e-6;
}

class Walker {
 public:
  Walker(const GrammarChunk& chunk, const std::vector<Range>& ranges) : chunk_(chunk), ranges_(ranges) {}

  WideBox level(uint32_t index, double a) const;

 private:
  WideBox leaf(const Shape& s, double a) const;
  WideBox prism(const Shape& s, double a) const;
  WideBox sum(const Shape& s, double a) const;
  WideBox anyChild(const Shape& s, double a) const {
    WideBox box;
    for (uint32_t i = 0; i < s.child_count; ++i) box.join(level(child(s, i), a));
    return box;
  }
  WideBox allChildren(const Shape& s, double a) const;
  uint32_t child(const Shape& s, uint32_t i) const { return chunk_.children[s.first_child + i]; }
  Range range(uint32_t expr) const { return expr < ranges_.size() ? ranges_[expr] : Range{-kInfinity, kInfinity}; }

  const GrammarChunk& chunk_;
  const std::vector<Range>& ranges_;
};

WideBox Walker::prism(const Shape& s, double a) const {
  double lo[2] = {kInfinity, kInfinity}, hi[2] = {-kInfinity, -kInfinity};
  for (uint32_t i = 0; i < s.point_count; ++i) {
    const Int3 p = chunk_.points[s.first_point + i];
    const double at[2] = {static_cast<double>(p.x), static_cast<double>(p.z)};
    for (int k = 0; k < 2; ++k) lo[k] = std::min(lo[k], at[k]), hi[k] = std::max(hi[k], at[k]);
  }
  if (s.point_count == 0) return {};
  return distance(s.frame, {(lo[0] + hi[0]) / 2, 0, (lo[1] + hi[1]) / 2},
                  {(hi[0] - lo[0]) / 2, wide(s.size[0]), (hi[1] - lo[1]) / 2}, a);
}

WideBox Walker::leaf(const Shape& s, double a) const {
  const auto size = [&](size_t i) { return wide(s.size[i]); };
  switch (s.kind) {
    case ShapeKind::sphere: {
      // A sphere looks the same under any rotation. So an unrotated frame is used, for which the box is exact.
      Frame upright;
      upright.origin = s.frame.origin;
      return placed(upright, size(0) + a, size(0) + a, size(0) + a);
    }
    case ShapeKind::box:
      return distance(s.frame, {}, {size(0), size(1), size(2)}, a);
    case ShapeKind::cylinder:
      return distance(s.frame, {}, {size(0), size(1), size(0)}, a);
    case ShapeKind::truncone: {
      const double r = std::max(size(0), size(1));
      return distance(s.frame, {}, {r, size(2), r}, a);
    }
    case ShapeKind::capsule: {
      const double r = size(0) + a;
      if (r < 0) return {};
      WideBox box;
      for (size_t j = 0; j < 3; ++j) {
        const double from = s.frame.origin[static_cast<int>(j)], to = from + size(1 + j);
        const double margin = r + slack(std::fabs(size(1 + j)) + r);
        box.lo[j] = std::min(from, to) - margin;
        box.hi[j] = std::max(from, to) + margin;
      }
      return box;
    }
    case ShapeKind::torus:
      return distance(s.frame, {}, {size(0) + size(1), size(1), size(0) + size(1)}, a);
    case ShapeKind::ellipsoid:
      return ellipsoid(s.frame, {size(0), size(1), size(2)}, a);
    case ShapeKind::superquadric:
      return scaledRadii(s.frame, {size(0), size(1), size(2)}, std::min({size(0), size(1), size(2)}), a);
    case ShapeKind::halfspace:
      return halfspace(s.frame, a);
    case ShapeKind::prism:
      return prism(s, a);
    case ShapeKind::voxels: {
      // The voxels are axis-aligned, so each axis is bounded separately: an infinite axis does not affect the others.
      WideBox box;
      for (size_t j = 0; j < 3; ++j) {
        const double half = size(j) + a + slack(size(j)) + slack(a), at = s.frame.origin[static_cast<int>(j)];
        box.lo[j] = at - half;
        box.hi[j] = at + half;
      }
      return box;
    }
    case ShapeKind::morph_power: {
      // The radii are linear in the morph parameter t, so their values at the two ends of t's range bound them.
      // Shape::size contains the radii at t = 0 and t = 1, which may be far larger than the radii within t's range.
      const Range along = range(s.expr);
      std::array<double, 3> most{};
      double least = kInfinity;
      for (double end : {std::clamp(along.lo, 0.0, 1.0), std::clamp(along.hi, 0.0, 1.0)}) {
        for (size_t i = 0; i < 3; ++i) {
          const double r = size(i) + (size(i + 3) - size(i)) * end;
          most[i] = std::max(most[i], r * (1 + 1e-6));
          least = std::min(least, r * (1 - 1e-6));
        }
      }
      return scaledRadii(s.frame, most, least, a);
    }
    default:
      return WideBox::everything();
  }
}

WideBox Walker::sum(const Shape& s, double a) const {
  double largest = 0;
  for (uint32_t i = 0; i < s.child_count; ++i) {
    largest = std::max(largest, wide(chunk_.shapes[child(s, i)].inner_radius));
  }
  if (!(largest > 0)) return s.child_count == 0 ? WideBox{} : WideBox::everything();
  const double reach = kernelReach(largest, s.child_count, a);
  if (std::isinf(reach)) return WideBox::everything();
  WideBox box;
  if (reach < 0) return box;
  for (uint32_t i = 0; i < s.child_count; ++i) {
    const uint32_t c = child(s, i);
    box.join(level(c, wide(chunk_.shapes[c].inner_radius) * (reach - 1.0)));
  }
  return box;
}

/// Returns the intersection of the children's boxes. It is valid at every level of detail: a level that drops one
/// operand of an intersection drops the whole intersection.
WideBox Walker::allChildren(const Shape& s, double a) const {
  if (s.child_count == 0) return {};
  WideBox box = WideBox::everything();
  for (uint32_t i = 0; i < s.child_count; ++i) box.clip(level(child(s, i), a));
  return box;
}

WideBox Walker::level(uint32_t index, double a) const {
  const Shape& s = chunk_.shapes[index];
  switch (s.kind) {
    case ShapeKind::unite:
      return anyChild(s, a);
    case ShapeKind::meet:
    case ShapeKind::meet_smooth:
      return allChildren(s, a);
    case ShapeKind::subtract:
    case ShapeKind::subtract_smooth:
      return s.child_count == 0 ? WideBox{} : level(child(s, 0), a);
    case ShapeKind::unite_smooth: {
      const double k = wide(s.amount);
      // For a < k, the round union of n children with the values d is at most `a` only if the squares of max(k - d, 0)
      // add up to at least (k - a)^2. So at least one square is (k - a)^2 / n or more.
      return anyChild(s, a < k ? k - (k - a) / std::sqrt(static_cast<double>(std::max(1u, s.child_count))) : a);
    }
    case ShapeKind::sum:
      return sum(s, a);
    case ShapeKind::morph:
      return anyChild(s, a);
    case ShapeKind::displace: {
      const double least = range(s.expr).lo * kUnitsPerMetre;
      if (std::isinf(least)) return WideBox::everything();
      return anyChild(s, a - least);
    }
    case ShapeKind::warp: {
      WideBox box = anyChild(s, a);
      if (box.empty()) return box;
      for (uint32_t j = 0; j < 3; ++j) {
        const Range offset = range(s.expr + j);
        box.lo[j] -= offset.hi * kUnitsPerMetre + 1;
        box.hi[j] -= offset.lo * kUnitsPerMetre - 1;
      }
      return box;
    }
    default:
      return leaf(s, a);
  }
}

}  // namespace

ShapeBounds::ShapeBounds(const GrammarChunk& chunk) : chunk_(chunk), ranges_(exprRanges(chunk.exprs)) {}

IntBox ShapeBounds::level(uint32_t shape, double a) const {
  const WideBox box = Walker(chunk_, ranges_).level(shape, a);
  if (box.empty()) return {};
  constexpr double kLow = std::numeric_limits<int32_t>::min(), kHigh = std::numeric_limits<int32_t>::max();
  IntBox result;
  for (int j = 0; j < 3; ++j) {
    const size_t i = static_cast<size_t>(j);
    result.lo[j] = static_cast<int32_t>(std::clamp(std::floor(box.lo[i]), kLow, kHigh));
    result.hi[j] = static_cast<int32_t>(std::clamp(std::ceil(box.hi[i]), kLow, kHigh));
  }
  return result;
}

IntBox levelBounds(const GrammarChunk& chunk, uint32_t shape, double a) { return ShapeBounds(chunk).level(shape, a); }

bool isBounded(const IntBox& box) {
  constexpr int32_t kLow = std::numeric_limits<int32_t>::min(), kHigh = std::numeric_limits<int32_t>::max();
  if (box.empty()) return true;
  for (int j = 0; j < 3; ++j) {
    if (box.lo[j] == kLow || box.hi[j] == kHigh) return false;
  }
  return true;
}

}  // namespace sgm
