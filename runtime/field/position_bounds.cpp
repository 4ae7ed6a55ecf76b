#include <algorithm>
#include <array>
#include <cmath>

#include "field/interval_arithmetic.h"
#include "field/lattice.h"
#include "field/reference.h"

namespace sgm {

namespace {

struct CentredBox {
  double x, y, z;     // x, y, z: centre
  double hx, hy, hz;  // half extents
};

CentredBox centred(const PositionBox& b) {
  return {(b.x.lo + b.x.hi) / 2, (b.y.lo + b.y.hi) / 2, (b.z.lo + b.z.hi) / 2,
          (b.x.hi - b.x.lo) / 2, (b.y.hi - b.y.lo) / 2, (b.z.hi - b.z.lo) / 2};
}

// Returns the exact range of squared distances from a ball's centre to the points of the box.
FloatInterval distance2(const uint32_t* p, const PositionBox& b) {
  auto axis = [](FloatInterval i, double c) { return squared(offsets(i, c)); };
  const FloatInterval x = axis(b.x, wholeAt(p, 1)), y = axis(b.y, wholeAt(p, 2)), z = axis(b.z, wholeAt(p, 3));
  return {x.lo + y.lo + z.lo, x.hi + y.hi + z.hi};
}

// The maximum slope of an octave is 15/4 per period. It occurs in the middle of a cell, along an axis, for the worst of
// the twelve gradient directions at each of its eight corners.
constexpr double kNoiseSlope = 3.7501;

// Bounds noise by its value at the box's middle, plus or minus the slope times the distance to the box's corners. The
// bounds are tight only for small boxes.
FloatInterval noiseBounds(const uint32_t* p, const PositionBox& box) {
  constexpr FloatInterval all{-1, 1};
  double slope = 0, weight = realAt(p, 5) * kNoiseSlope;
  for (uint32_t k = 0; k < p[3]; ++k, weight *= 0.5) slope += weight / wholeAt(p, static_cast<int>(6 + 2 * k));
  double square = 0;
  Int3 middle;
  const std::array<FloatInterval, 3> axes{box.x, box.y, box.z};
  for (int axis = 0; axis < 3; ++axis) {
    const FloatInterval side = axes[static_cast<size_t>(axis)];
    // The noise lattice wraps around at the ends of int32. If an offset could leave that range, the noise can have any
    // value.
    const double anchor = wholeAt(p, axis);
    if (side.lo - anchor < -2147483648.0 || side.hi - anchor > 2147483647.0) return all;
    middle[axis] = static_cast<int32_t>(std::floor((side.lo + side.hi) / 2));
    const double away = std::max(side.hi - middle[axis], middle[axis] - side.lo);
    square += away * away;
  }
  const double change = slope * std::sqrt(square);
  if (!(change < 1)) return all;
  const double v = referenceNoise(p, middle), error = errorOf(Op::noise);
  return {std::max(-1.0, v - change - error), std::min(1.0, v + change + error)};
}

// The ranges of the local coordinates |x|, |y|, |z| over a box. They bound every value that is monotone in these
// coordinates, nearly tightly if the frame is axis-aligned, however long the box's diagonal is.
struct LocalRange {
  std::array<double, 3> near{}, far{};  ///< minimum and maximum of |q| along each local axis
};

LocalRange localRange(const uint32_t* p, const CentredBox& c) {
  const std::array<double, 3> at{c.x, c.y, c.z};
  std::array<double, 3> d{};
  for (size_t axis = 0; axis < 3; ++axis) {
    d[axis] = offsets({at[axis], at[axis]}, wholeAt(p, 1 + static_cast<int>(axis))).lo;
  }
  LocalRange r;
  for (size_t i = 0; i < 3; ++i) {
    const int row = 4 + 3 * static_cast<int>(i);
    const double x = realAt(p, row), y = realAt(p, row + 1), z = realAt(p, row + 2);
    const double q = std::abs(x * d[0] + y * d[1] + z * d[2]);
    const double reach = std::abs(x) * c.hx + std::abs(y) * c.hy + std::abs(z) * c.hz;
    r.near[i] = std::max(0.0, q - reach);
    r.far[i] = q + reach;
  }
  return r;
}

double boxDistance(const uint32_t* p, const std::array<double, 3>& q) {
  double square = 0, inner = -kLimit;
  for (size_t i = 0; i < 3; ++i) {
    const double a = q[i] - realAt(p, 13 + static_cast<int>(i)), out = std::max(a, 0.0);
    square += out * out;
    inner = std::max(inner, a);
  }
  return std::sqrt(square) + std::min(inner, 0.0);
}

double cylinderDistance(double radius, double half_height, const std::array<double, 3>& q) {
  const double a = std::sqrt(q[0] * q[0] + q[2] * q[2]) - radius, b = q[1] - half_height;
  const double outer_a = std::max(a, 0.0), outer_b = std::max(b, 0.0);
  return std::sqrt(outer_a * outer_a + outer_b * outer_b) + std::min(std::max(a, b), 0.0);
}

// Bounds the distance from a capsule: the distance from its axis, a segment, minus its radius. The distance from a
// convex set is convex, so it is nowhere below its tangent at the box's middle. It is also nowhere above the distance
// from the point of the axis that is nearest to the middle. Neither bound differs from the value at the middle by more
// than half the box's diagonal.
FloatInterval capsuleRange(const uint32_t* p, const CentredBox& c) {
  auto offset = [&](double at, int word) { return offsets({at, at}, wholeAt(p, word)).lo; };
  std::array<double, 3> d{offset(c.x, 1), offset(c.y, 2), offset(c.z, 3)};
  const std::array<double, 3> axis{realAt(p, 4), realAt(p, 5), realAt(p, 6)}, half{c.hx, c.hy, c.hz};
  double along = 0, length2 = 0;
  for (size_t i = 0; i < 3; ++i) {
    along += d[i] * axis[i];
    length2 += axis[i] * axis[i];
  }
  const double t = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  double square = 0, slope = 0, far2 = 0;
  for (size_t i = 0; i < 3; ++i) {
    const double away = std::abs(d[i] - t * axis[i]);
    square += away * away;
    slope += away * half[i];
    far2 += (away + half[i]) * (away + half[i]);
  }
  const double distance = std::sqrt(square);
  const double lowest = distance > 0 ? distance - slope / distance : 0.0;
  return {std::max(lowest, 0.0) - realAt(p, 8), std::sqrt(far2) - realAt(p, 8)};
}

// Bounds a primitive by its geometry, often tighter than its value at the middle plus or minus half the diagonal.
// Returns an infinite range for primitives without such a bound.
FloatInterval primitiveRange(Op op, const uint32_t* p, const CentredBox& c) {
  switch (op) {
    case Op::box: {
      const LocalRange r = localRange(p, c);
      return {boxDistance(p, r.near), boxDistance(p, r.far)};
    }
    case Op::cylinder: {
      const LocalRange r = localRange(p, c);
      return {cylinderDistance(realAt(p, 13), realAt(p, 14), r.near),
              cylinderDistance(realAt(p, 13), realAt(p, 14), r.far)};
    }
    case Op::truncone: {  // a truncated cone lies between its inscribed and its enclosing cylinder
      const LocalRange r = localRange(p, c);
      const double bottom = realAt(p, 13), top = realAt(p, 14), height = realAt(p, 15);
      return {cylinderDistance(std::max(bottom, top), height, r.near),
              cylinderDistance(std::min(bottom, top), height, r.far)};
    }
    case Op::ellipsoid: {
      const LocalRange r = localRange(p, c);
      auto at = [&](const std::array<double, 3>& q) {
        const double x = q[0] * realAt(p, 13), y = q[1] * realAt(p, 14), z = q[2] * realAt(p, 15);
        return (std::sqrt(x * x + y * y + z * z) - 1) * realAt(p, 16);
      };
      return {at(r.near), at(r.far)};
    }
    default:
      return {-kLimit, kLimit};
  }
}

// Bounds a power morph: the smallest radius times (||u||_n - 1), where u is the local position divided by the radii. As
// t increases, the exponent n grows, so that the norm falls; the radii change, too. The bounds treat both effects
// separately: ||u||_max <= ||u||_n <= ||u||_2, each for the smaller and the larger radii at the ends of t. radius: half
// the box's diagonal.
FloatInterval powerMorphRange(const uint32_t* p, const CentredBox& c, double radius, FloatInterval t) {
  const FloatInterval s = clamped(t, 0, 1);
  if (s.lo == s.hi) {
    const double v = referencePowerMorph(p, s.lo, c.x, c.y, c.z);
    return {v - radius, v + radius};
  }
  std::array<FloatInterval, 3> radii{};
  for (int i = 0; i < 3; ++i) {
    const double a = realAt(p, 13 + i), b = realAt(p, 16 + i);
    const double r0 = (1 - s.lo) * a + s.lo * b, r1 = (1 - s.hi) * a + s.hi * b;
    radii[static_cast<size_t>(i)] = {std::min(r0, r1), std::max(r0, r1)};
  }
  auto offset = [&](double at, int word) { return offsets({at, at}, wholeAt(p, word)).lo; };
  const double dx = offset(c.x, 1), dy = offset(c.y, 2), dz = offset(c.z, 3);
  auto row = [&](int i) { return realAt(p, i) * dx + realAt(p, i + 1) * dy + realAt(p, i + 2) * dz; };
  double low = 0, high2 = 0;
  for (int i = 0; i < 3; ++i) {
    const double q = std::abs(row(4 + 3 * i));
    const FloatInterval r = radii[static_cast<size_t>(i)];
    low = std::max(low, std::max(0.0, q - radius) / r.hi);
    const double u = (q + radius) / r.lo;
    high2 += u * u;
  }
  const double smallest_lo = std::min({radii[0].lo, radii[1].lo, radii[2].lo});
  const double smallest_hi = std::min({radii[0].hi, radii[1].hi, radii[2].hi});
  auto scaled = [&](double norm, bool lower) {
    const double v = norm - 1;
    return v * ((v > 0) == lower ? smallest_lo : smallest_hi);
  };
  return {scaled(low, true), scaled(std::sqrt(high2), false)};
}

// Returns an upper bound of the distance of the box's points from the centre: the sum of the distances along the axes,
// which needs no square root.
double farthestOffset(const uint32_t* p, const CentredBox& c) {
  auto offset = [&](double at, int word) { return std::abs(offsets({at, at}, wholeAt(p, word)).lo); };
  return offset(c.x, 1) + c.hx + offset(c.y, 2) + c.hy + offset(c.z, 3) + c.hz;
}

}  // namespace

double sizeSum(Op op, const uint32_t* p) {
  auto sum = [&](int first, int last) {
    double s = 0;
    for (int i = first; i <= last; ++i) s += std::abs(realAt(p, i));
    return s;
  };
  switch (op) {
    case Op::sphere:
      return sum(4, 4);
    case Op::capsule:
      return sum(4, 6) + sum(8, 8);
    case Op::box:
      return sum(13, 15);
    case Op::cylinder:
    case Op::torus:
      return sum(13, 14);
    case Op::truncone:
      return sum(13, 15);
    case Op::ellipsoid:
    case Op::superquadric:
      return sum(16, 16);
    case Op::power_morph:
      return sum(13, 18);
    case Op::prism: {
      double s = sum(13, 13), corner = 0;
      for (int k = 0; k < static_cast<int>(p[14]); ++k) corner = std::max(corner, sum(15 + 6 * k, 18 + 6 * k));
      return s + corner;
    }
    default:
      return 0;
  }
}

FloatInterval boundPosition(Op op, const uint32_t* p, const PositionBox& box, FloatInterval t) {
  switch (op) {
    case Op::noise:
      return noiseBounds(p, box);
    case Op::sweep:
      return {-1e-6, 1 + 1e-6};
    case Op::lattice:
      return boundLattice(p, box);
    case Op::coordinate: {
      const FloatInterval x = product(offsets(box.x, wholeAt(p, 1)), {realAt(p, 4), realAt(p, 4)});
      const FloatInterval y = product(offsets(box.y, wholeAt(p, 2)), {realAt(p, 5), realAt(p, 5)});
      const FloatInterval z = product(offsets(box.z, wholeAt(p, 3)), {realAt(p, 6), realAt(p, 6)});
      const FloatInterval v{x.lo + y.lo + z.lo, x.hi + y.hi + z.hi};
      return widened(v, errorOf(op) * (magnitude(x) + magnitude(y) + magnitude(z)));
    }
    case Op::blob: {
      const FloatInterval d2 = distance2(p, box);
      return kernelBounds({d2.lo * realAt(p, 4), d2.hi * realAt(p, 4)}, errorOf(op));
    }
    case Op::sphere: {
      const FloatInterval d2 = distance2(p, box);
      const FloatInterval d{std::sqrt(d2.lo) - realAt(p, 4), std::sqrt(d2.hi) - realAt(p, 4)};
      return widened(d, errorOf(op) * (std::sqrt(d2.hi) + realAt(p, 4)));
    }
    default:
      break;
  }
  // No primitive has a slope above 1 (primitives.h), so its value in the box is the value at the centre, plus or minus
  // at most half the diagonal.
  const CentredBox c = centred(box);
  const double radius = std::sqrt(c.hx * c.hx + c.hy * c.hy + c.hz * c.hz);
  const double error = errorOf(op) * (farthestOffset(p, c) + sizeSum(op, p)) + radius * 1e-6;
  if (op == Op::power_morph) return widened(powerMorphRange(p, c, radius, t), error);
  if (op == Op::capsule) return widened(capsuleRange(p, c), error);
  const double v = referencePrimitive(op, p, c.x, c.y, c.z);
  if (op == Op::halfspace) {  // for a linear function, the range is exact
    const double reach = std::abs(realAt(p, 7)) * c.hx + std::abs(realAt(p, 8)) * c.hy + std::abs(realAt(p, 9)) * c.hz;
    return widened({v - reach, v + reach}, error);
  }
  const FloatInterval range = primitiveRange(op, p, c);
  return widened({std::max(v - radius, range.lo), std::min(v + radius, range.hi)}, error);
}

}  // namespace sgm
