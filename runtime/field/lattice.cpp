#include "field/lattice.h"

#include <algorithm>
#include <cmath>

#include "field/reference.h"

namespace sgm {

namespace {

// indices of the op's parameter words (shaders/common/lattice.h)
constexpr int kSpacingWord = 4, kCountWord = 5, kLimitWord = 9, kSamplesWord = 10;
constexpr double kFarAway = double{kFarSample};
constexpr int64_t kMaxPoints = int64_t{1} << 25;
constexpr double kFarthest = 1 << 30;

/// Converts the position `at` along an axis to lattice cells, and clamps it to the inner cells, because the first and
/// the last cell only serve to compute slopes.
double along(const uint32_t* p, int axis, double at) {
  const double last = wholeAt(p, kCountWord + axis) - 2;
  const double offset = std::clamp(at - wholeAt(p, 1 + axis), 0.0, kFarthest);
  return std::clamp(offset / wholeAt(p, kSpacingWord), 1.0, last);
}

int64_t cellAt(const uint32_t* p, int axis, double along_axis) {
  return std::min(static_cast<int64_t>(std::floor(along_axis)), static_cast<int64_t>(p[kCountWord + axis]) - 3);
}

double sampleAt(const uint32_t* p, int64_t x, int64_t y, int64_t z) {
  const auto row = static_cast<int64_t>(p[kCountWord]), column = static_cast<int64_t>(p[kCountWord + 1]);
  return realAt(p + kSamplesWord, static_cast<int>((z * column + y) * row + x));
}

/// Returns the trilinear interpolation of the samples at the corners of a cell. at: position in cells.
double mixedAt(const uint32_t* p, const std::array<double, 3>& at) {
  std::array<int64_t, 3> cell{};
  std::array<double, 3> t{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    cell[a] = cellAt(p, axis, at[a]);
    t[a] = at[a] - static_cast<double>(cell[a]);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    std::array<int64_t, 3> place = cell;
    double weight = 1;
    for (size_t a = 0; a < 3; ++a) {
      const bool high = corner >> a & 1;
      place[a] += high;
      weight *= high ? t[a] : 1 - t[a];
    }
    if (weight > 0) sum += weight * sampleAt(p, place[0], place[1], place[2]);
  }
  return sum;
}

double farOrNot(const uint32_t* p, double v) {
  const double limit = realAt(p, kLimitWord);
  return v >= limit ? kFarAway : v <= -limit ? -kFarAway : v;
}

}  // namespace

SampleLattice latticeAround(const IntBox& box, int32_t spacing) {
  const int64_t world_first = -(INT64_C(2147483648) / spacing), world_last = INT64_C(2147483647) / spacing;
  SampleLattice lattice;
  lattice.spacing = spacing;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t first = std::clamp(floorDiv(box.lo[axis], spacing) - 1, world_first, world_last - 3);
    const int64_t last = std::clamp(floorDiv(box.hi[axis], spacing) + 2, first + 3, world_last);
    lattice.origin[axis] = static_cast<int32_t>(first * spacing);
    lattice.count[static_cast<size_t>(axis)] = static_cast<uint32_t>(last - first + 1);
  }
  return lattice;
}

std::optional<size_t> latticePoints(const SampleLattice& lattice) {
  int64_t points = 1;
  for (const uint32_t count : lattice.count) {
    points *= count;
    if (points > kMaxPoints || int64_t{count} * lattice.spacing > static_cast<int64_t>(kFarthest)) return std::nullopt;
  }
  return static_cast<size_t>(points);
}

FloatInterval boundLattice(const uint32_t* p, const PositionBox& box) {
  const std::array<FloatInterval, 3> axes{box.x, box.y, box.z};
  std::array<FloatInterval, 3> range{};
  std::array<int64_t, 3> first{}, last{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    range[a] = {along(p, axis, axes[a].lo), along(p, axis, axes[a].hi)};
    first[a] = cellAt(p, axis, range[a].lo);
    last[a] = cellAt(p, axis, range[a].hi) + 1;
  }
  FloatInterval all{kFarAway, -kFarAway};
  for (int64_t z = first[2]; z <= last[2]; ++z) {
    for (int64_t y = first[1]; y <= last[1]; ++y) {
      for (int64_t x = first[0]; x <= last[0]; ++x) {
        const double sample = sampleAt(p, x, y, z);
        all = {std::min(all.lo, sample), std::max(all.hi, sample)};
      }
    }
  }
  const double slack = statedError(Op::lattice) * std::max(std::abs(all.lo), std::abs(all.hi));
  // If the box lies in one cell, the value is linear along each axis, so its values at the box's corners bound it.
  if (last[0] == first[0] + 1 && last[1] == first[1] + 1 && last[2] == first[2] + 1) {
    all = {kFarAway, -kFarAway};
    for (int corner = 0; corner < 8; ++corner) {
      std::array<double, 3> at{};
      for (size_t a = 0; a < 3; ++a) at[a] = (corner >> a & 1) != 0 ? range[a].hi : range[a].lo;
      const double value = mixedAt(p, at);
      all = {std::min(all.lo, value), std::max(all.hi, value)};
    }
  }
  // A value at or beyond the limit becomes the far value, so the bounds must include the far value if they reach the
  // limit.
  const double limit = realAt(p, kLimitWord);
  const double lo = all.lo - slack, hi = all.hi + slack;
  return {lo >= limit    ? kFarAway
          : lo <= -limit ? -kFarAway
                         : lo,
          hi <= -limit  ? -kFarAway
          : hi >= limit ? kFarAway
                        : hi};
}

double referenceLattice(const uint32_t* p, double x, double y, double z) {
  return farOrNot(p, mixedAt(p, {along(p, 0, x), along(p, 1, y), along(p, 2, z)}));
}

}  // namespace sgm
