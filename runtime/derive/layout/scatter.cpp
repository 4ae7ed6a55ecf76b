#include "derive/layout/scatter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "base/math.h"
#include "derive/draws.h"

namespace sgm {
namespace {

double uniform(PathKey key, size_t index, uint64_t axis) { return key.unit(index * 4 + axis); }

constexpr double kTwoPi = 2 * kPi;
constexpr double kGoldenAngle = 2.399963229728653;

}  // namespace

std::optional<std::vector<LatticePoint>> poissonInCell(const Lattice& lattice, Int3 cell, PathKey key, int32_t radius,
                                                       size_t limit) {
  struct Candidate {
    std::array<int64_t, 3> at{};
    uint64_t priority = 0;
    PathKey key;
  };
  const int64_t step = std::max(radius, 1);
  std::array<int64_t, 3> low{}, first{}, count{1, 1, 1};
  size_t total = 1;
  for (int a = 0; a < 3; ++a) {
    const size_t i = static_cast<size_t>(a);
    if (!lattice.hasAxis(a)) continue;
    low[i] = int64_t{cell[a]} * lattice.size[a];
    // The array has one more cube on each side of the cell. Candidates that are two cubes apart are farther apart than
    // the radius, so no more cubes are needed.
    first[i] = floorDiv(low[i], step) - 1;
    count[i] = floorDiv(low[i] + lattice.size[a] - 1, step) + 1 - first[i] + 1;
    if (static_cast<size_t>(count[i]) > limit / total) return std::nullopt;
    total *= static_cast<size_t>(count[i]);
  }
  std::vector<Candidate> candidates(total);
  const auto index = [&](int64_t x, int64_t y, int64_t z) {
    return static_cast<size_t>((z * count[1] + y) * count[0] + x);
  };
  const auto under = [](PathKey above, int64_t cube) {
    return PathKey{hashCombine(above.value, static_cast<uint64_t>(cube))};
  };
  for (int64_t x = 0; x < count[0]; ++x) {
    const PathKey plane = under(key, first[0] + x);
    for (int64_t y = 0; y < count[1]; ++y) {
      const PathKey row = under(plane, first[1] + y);
      for (int64_t z = 0; z < count[2]; ++z) {
        Candidate& c = candidates[index(x, y, z)];
        const std::array<int64_t, 3> cube{first[0] + x, first[1] + y, first[2] + z};
        c.key = under(row, cube[2]);
        c.priority = hashCombine(c.key.value, kPriorityDraw);
        for (int a = 0; a < 3; ++a) {
          const size_t i = static_cast<size_t>(a);
          if (!lattice.hasAxis(a)) continue;
          c.at[i] = cube[i] * step + static_cast<int64_t>(c.key.unit(i) * static_cast<double>(step));
        }
      }
    }
  }
  // Index offsets of the surrounding cubes, nearest first, because most candidates are rejected by a candidate in an
  // adjacent cube.
  std::vector<std::ptrdiff_t> around;
  for (int64_t shared = 2; shared >= 0; --shared) {
    for (int64_t k = -1; k <= 1; ++k) {
      for (int64_t j = -1; j <= 1; ++j) {
        for (int64_t i = -1; i <= 1; ++i) {
          const bool there =
              (i == 0 || lattice.hasAxis(0)) && (j == 0 || lattice.hasAxis(1)) && (k == 0 || lattice.hasAxis(2));
          if (there && (i == 0) + (j == 0) + (k == 0) == shared) around.push_back((k * count[1] + j) * count[0] + i);
        }
      }
    }
  }
  const auto wins = [&](const Candidate& c) {
    return std::none_of(around.begin(), around.end(), [&](std::ptrdiff_t away) {
      const Candidate& other = *(&c + away);
      // Only another candidate with a higher priority can reject candidate c. For equal priorities, the positions
      // decide, so that the result is the same from the view of both candidates.
      if (other.priority < c.priority || (other.priority == c.priority && other.at <= c.at)) return false;
      // If the distance along one axis reaches the radius, the candidate is far enough away. Otherwise each squared
      // distance is so small that the sum of squares cannot overflow.
      uint64_t square = 0;
      for (size_t a = 0; a < 3; ++a) {
        const auto d = static_cast<uint64_t>(std::abs(other.at[a] - c.at[a]));
        if (d >= static_cast<uint64_t>(step)) return false;
        square += d * d;
      }
      return square < static_cast<uint64_t>(step) * static_cast<uint64_t>(step);
    });
  };
  std::vector<LatticePoint> points;
  for (size_t z = 0; z < static_cast<size_t>(count[2]); ++z) {
    for (size_t y = 0; y < static_cast<size_t>(count[1]); ++y) {
      for (size_t x = 0; x < static_cast<size_t>(count[0]); ++x) {
        const Candidate& c = candidates[(z * static_cast<size_t>(count[1]) + y) * static_cast<size_t>(count[0]) + x];
        Int3 offset;
        bool inside = true;
        for (int a = 0; a < 3; ++a) {
          const size_t i = static_cast<size_t>(a);
          const int64_t d = c.at[i] - low[i];
          inside = inside && d >= 0 && d < std::max(lattice.size[a], 1);
          offset[a] = saturate(d);
        }
        // c is not in an outermost cube of the array, so all surrounding cubes exist.
        if (inside && wins(c)) points.push_back({offset, c.key});
      }
    }
  }
  return points;
}

std::vector<Vec3> scatterOnShell(PathKey key, size_t count, double radius, double up) {
  std::vector<Vec3> points;
  points.reserve(count);
  const double turn = kTwoPi * key.unit(~uint64_t{0});
  for (size_t i = 0; i < count; ++i) {
    // By Archimedes' theorem, slices of a sphere with equal height have equal areas.
    const double strip = (static_cast<double>(i) + uniform(key, i, 0)) / static_cast<double>(count);
    const double y = 1.0 - 2.0 * up * strip;
    const double around = turn + kGoldenAngle * static_cast<double>(i) + (uniform(key, i, 1) - 0.5) * 0.8;
    const double ring = radius * std::sqrt(std::max(0.0, 1.0 - y * y));
    points.push_back({ring * detCos(around), radius * y, ring * detSin(around)});
  }
  return points;
}

std::vector<Vec3> scatterInBox(PathKey key, size_t count, Vec3 edges) {
  std::vector<Vec3> points;
  points.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    points.push_back({edges.x * (uniform(key, i, 0) - 0.5), edges.y * (uniform(key, i, 1) - 0.5),
                      edges.z * (uniform(key, i, 2) - 0.5)});
  }
  return points;
}

std::vector<Vec3> scatterOnDisc(PathKey key, size_t count, double radius) {
  std::vector<Vec3> points;
  points.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const double ring = radius * std::sqrt(uniform(key, i, 0)), around = kTwoPi * uniform(key, i, 1);
    points.push_back({ring * detCos(around), 0, ring * detSin(around)});
  }
  return points;
}

std::vector<size_t> thinned(PathKey key, const std::vector<Vec3>& points, double radius) {
  std::vector<size_t> kept;
  for (size_t i = 0; i < points.size(); ++i) {
    const uint64_t mine = hashCombine(key.value, i * 4 + 3);
    bool wins = true;
    for (size_t j = 0; j < points.size() && wins; ++j) {
      const Vec3 d = points[j] - points[i];
      const uint64_t theirs = hashCombine(key.value, j * 4 + 3);
      wins = j == i || dot(d, d) >= radius * radius || theirs < mine || (theirs == mine && j > i);
    }
    if (wins) kept.push_back(i);
  }
  return kept;
}

}  // namespace sgm
