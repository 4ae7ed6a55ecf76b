#include "field/lattice.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "field/reference.h"

namespace sgm {

namespace {

constexpr int kSpacingWord = 4, kCountWord = 5, kLimitWord = 9, kSamplesWord = 10;  // words (shaders/common/lattice.h)
constexpr double kFarAway = double{1e18f};
constexpr double kFarthest = 1 << 30;

/// How far along an axis, in cells.
double along(const uint32_t* p, int axis, double at) {
  const double last = wholeAt(p, kCountWord + axis) - 1;
  const double offset = std::clamp(at - wholeAt(p, 1 + axis), 0.0, kFarthest);
  return std::min(offset / wholeAt(p, kSpacingWord), last);
}

double sampleAt(const uint32_t* p, int64_t x, int64_t y, int64_t z) {
  const auto row = static_cast<int64_t>(p[kCountWord]), column = static_cast<int64_t>(p[kCountWord + 1]);
  return realAt(p + kSamplesWord, static_cast<int>((z * column + y) * row + x));
}

double farOrNot(const uint32_t* p, double v) {
  const double limit = realAt(p, kLimitWord);
  return v >= limit ? kFarAway : v <= -limit ? -kFarAway : v;
}

}  // namespace

Result<SampleLattice> latticeAround(const IntBox& box, int32_t spacing) {
  SampleLattice lattice;
  lattice.spacing = spacing;
  int64_t points = 1;
  for (int axis = 0; axis < 3; ++axis) {
    int64_t first = floorDiv(box.lo[axis], spacing), last = floorDiv(box.hi[axis], spacing) + 1;
    // Where the world ends on an incomplete cell, the last whole one goes on.
    if (first * spacing < INT32_MIN) ++first;
    if (last * spacing > INT32_MAX) --last;
    first = std::min(first, last - 1);
    points *= std::min(last - first + 1, kMostLatticePoints + 1);
    if (points > kMostLatticePoints || (last - first) * spacing > int64_t{1} << 30) {
      return Error{Code::limit, "the box takes more than " + std::to_string(kMostLatticePoints) +
                                    " samples of a field of the host's; ask for a smaller one"};
    }
    lattice.origin[axis] = saturate(first * spacing);
    lattice.count[static_cast<size_t>(axis)] = static_cast<uint32_t>(last - first + 1);
  }
  return lattice;
}

Interval boundLattice(const uint32_t* p, const PlaceBox& box) {
  const std::array<Interval, 3> axes{box.x, box.y, box.z};
  std::array<int64_t, 3> first{}, last{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    first[a] = static_cast<int64_t>(std::floor(along(p, axis, axes[a].lo)));
    last[a] = static_cast<int64_t>(std::ceil(along(p, axis, axes[a].hi)));
  }
  Interval all{kFarAway, -kFarAway};
  for (int64_t z = first[2]; z <= last[2]; ++z) {
    for (int64_t y = first[1]; y <= last[1]; ++y) {
      for (int64_t x = first[0]; x <= last[0]; ++x) {
        const double sample = sampleAt(p, x, y, z);
        all = {std::min(all.lo, sample), std::max(all.hi, sample)};
      }
    }
  }
  const double slack = statedError(Op::lattice) * std::max(std::abs(all.lo), std::abs(all.hi));
  // What may count as far may be as far.
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
  const std::array<double, 3> at{along(p, 0, x), along(p, 1, y), along(p, 2, z)};
  std::array<int64_t, 3> cell{};
  std::array<double, 3> t{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    cell[a] = std::min(static_cast<int64_t>(std::floor(at[a])), static_cast<int64_t>(p[kCountWord + axis]) - 2);
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
  return farOrNot(p, sum);
}

}  // namespace sgm
