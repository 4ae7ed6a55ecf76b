// Tests folds, cuts and piercing of triangles: integers give the same results as doubles, and counting by cells the
// same as testing all pairs.

#include <random>

#include "catch.h"
#include "measure/triangle_pair.h"
#include "mesh/body_pairs.h"
#include "rounds.h"

using namespace sgm;
using measure::Point;

namespace {

using Places = std::array<Int3, 3>;

std::array<Point, 3> inDoubles(const Places& t) {
  std::array<Point, 3> points;
  for (size_t k = 0; k < 3; ++k)
    points[k] = {static_cast<double>(t[k].x), static_cast<double>(t[k].y), static_cast<double>(t[k].z)};
  return points;
}

int32_t anyOf(std::mt19937& random, int32_t count) {
  return static_cast<int32_t>(random() % static_cast<uint32_t>(count));
}

/// Random triangles on a lattice with few positions, so that triangles often share planes, lines and corners.
Places onLattice(std::mt19937& random, int32_t places, int32_t step) {
  Places t;
  for (Int3& p : t) p = {step * anyOf(random, places), step * anyOf(random, places), step * anyOf(random, places)};
  return t;
}

PairFault integerFault(Places a, Places b) {
  const int shared = sharedFirst(a, b);
  return TrianglePair<IntegerSigns>::faultOf(a, b, shared);
}

/// Counts faults by testing all pairs.
PairCounts countAll(std::span<const PairCorner> corners) {
  const auto cornersOf = [&](size_t t) {
    std::array<Point, 3> points;
    for (size_t k = 0; k < 3; ++k) {
      const PairCorner& c = corners[3 * t + k];
      points[k] = {static_cast<double>(c.x), static_cast<double>(c.y), static_cast<double>(c.z)};
    }
    return points;
  };
  PairCounts counts;
  for (size_t a = 0; a < corners.size() / 3; ++a) {
    for (size_t b = a + 1; b < corners.size() / 3; ++b) {
      const PairFault fault = measure::pairFault(cornersOf(a), cornersOf(b));
      counts.folded += fault == PairFault::folded;
      counts.cut += fault == PairFault::cut;
    }
  }
  return counts;
}

PairCounts counted(std::span<const PairCorner> corners) {
  PairScratch scratch(std::pmr::get_default_resource());
  return countPairs(corners, scratch);
}

PairCorner cornerAt(int x, int y, int z, uint16_t kind) {
  return {static_cast<int16_t>(x), static_cast<int16_t>(y), static_cast<int16_t>(z), kind};
}

}  // namespace

TEST_CASE("integers say of two triangles what doubles do", "[faults]") {
  std::array<size_t, 3> seen{};
  size_t pierced = 0;
  std::mt19937 random(1);
  for (unsigned round = 0; round < rounds(100000); ++round) {
    const int32_t places = 2 + anyOf(random, 6), step = 1 + anyOf(random, 1000);
    const Places a = onLattice(random, places, step), b = onLattice(random, places, step);
    const PairFault fault = integerFault(a, b);
    CHECK(fault == measure::pairFault(inDoubles(a), inDoubles(b)));
    CHECK(fault == integerFault(b, a));
    const bool through = TrianglePair<IntegerSigns>::pierce(a, b);
    CHECK(through == measure::pierce(inDoubles(a), inDoubles(b)));
    // A triangle that passes through another one also cuts it, if both have an area.
    if (through && IntegerSigns::seenAlong(a) >= 0 && IntegerSigns::seenAlong(b) >= 0) CHECK(fault == PairFault::cut);
    ++seen[static_cast<size_t>(fault)];
    pierced += through;
  }
  for (const size_t count : seen) CHECK(count * 1000 > rounds(100000));
  CHECK(pierced * 200 > rounds(100000));
}

TEST_CASE("folds, cuts and piercing by hand", "[faults]") {
  const Places floor{{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}};
  const auto fault = [&](const Places& other) { return integerFault(floor, other); };
  CHECK(fault({{{8, 0, 0}, {0, 0, 0}, {2, 2, 0}}}) == PairFault::folded);
  CHECK(fault({{{8, 0, 0}, {0, 0, 0}, {2, -2, 0}}}) == PairFault::none);
  CHECK(fault({{{8, 0, 0}, {0, 0, 0}, {2, 2, 1}}}) == PairFault::none);
  // Two triangles with the same corners are no fault here, because another check detects duplicates by their corner
  // numbers.
  CHECK(fault({{{0, 8, 0}, {8, 0, 0}, {0, 0, 0}}}) == PairFault::none);
  CHECK(fault({{{1, 1, -1}, {1, 1, 1}, {9, 9, 9}}}) == PairFault::cut);
  // One corner touches the floor: that is a cut, but not a piercing.
  CHECK(fault({{{1, 1, 0}, {1, 1, 1}, {9, 9, 9}}}) == PairFault::cut);
  CHECK(fault({{{0, 0, 0}, {4, 4, 1}, {4, 4, -1}}}) == PairFault::cut);
  CHECK(fault({{{0, 0, 0}, {4, 4, 0}, {4, 4, 0}}}) == PairFault::none);  // the second triangle has no area
  const auto pierce = [&](const Places& other) { return TrianglePair<IntegerSigns>::pierce(floor, other); };
  CHECK(pierce({{{1, 1, -1}, {1, 1, 1}, {9, 9, 9}}}));
  CHECK_FALSE(pierce({{{1, 1, 0}, {1, 1, 1}, {9, 9, 9}}}));
  CHECK_FALSE(pierce({{{8, 0, 0}, {0, 0, 0}, {2, 2, 0}}}));
  CHECK_FALSE(pierce({{{4, 0, -1}, {4, 0, 1}, {4, -9, 0}}}));  // passes through an edge of the floor
}

TEST_CASE("corners of a seam may lie in one place where one is of each level", "[faults]") {
  const uint16_t own = kFeature, coarser = kFeature | kFeatureOfCoarser;
  for (const uint16_t fine : {static_cast<uint16_t>(kOwnEdge), own}) {
    for (const uint16_t coarse : {static_cast<uint16_t>(kCoarserEdge), coarser}) {
      CHECK(maySharePlace(fine, coarse));
      CHECK(maySharePlace(coarse, fine));
      CHECK_FALSE(maySharePlace(fine, kLateralEdge));
      CHECK_FALSE(maySharePlace(coarse, kLateralEdge));
    }
  }
  CHECK_FALSE(maySharePlace(kOwnEdge, own));
  CHECK_FALSE(maySharePlace(kCoarserEdge, coarser));
  CHECK_FALSE(maySharePlace(kLateralEdge, kLateralEdge));
}

TEST_CASE("a body's pairs are those of all against all where all are wide", "[faults]") {
  PairCounts all;
  for (unsigned seed = 0; seed < std::max(rounds(200), 200u); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::vector<PairCorner> corners;
    const int32_t step = 1 << anyOf(random, 8), reach = 2 + anyOf(random, 1024 / step - 1);
    const int from = anyOf(random, 2) == 0 ? -512 : 256 * anyOf(random, 29);
    for (int i = 0; i < 120; ++i) {
      for (int k = 0; k < 3; ++k) {
        const auto place = [&] { return from + step * anyOf(random, reach); };
        if (k > 0 && !corners.empty() && anyOf(random, 4) == 0) {
          corners.push_back(corners[static_cast<size_t>(anyOf(random, static_cast<int32_t>(corners.size())))]);
        } else {
          const int x = place(), y = place(), z = place();
          corners.push_back(cornerAt(x, y, z, kFeature));
        }
      }
    }
    const PairCounts counts = counted(corners);
    CHECK(counts == countAll(corners));
    all += counts;
  }
  CHECK(all.folded > 20);
  CHECK(all.cut > 2000);
}

TEST_CASE("a body's pairs are those within each cell where none is wide", "[faults]") {
  PairCounts all;
  for (unsigned seed = 0; seed < std::max(rounds(200), 200u); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::vector<PairCorner> corners;
    PairCounts expected;
    // The corners are in the order of their cells, as in the body of a chunk.
    for (int cell = 0; cell < 20; ++cell) {
      std::vector<PairCorner> of_cell;
      for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < 3; ++k) {
          const auto place = [&] { return 128 * anyOf(random, 3); };
          // On each axis, one corner of the triangle lies in the cell's low face. A triangle that lies completely in a
          // high face of the cell would belong to the next cell.
          const int x = k == 0 ? 0 : place(), y = k == 1 ? 0 : place(), z = k == 2 ? 0 : place();
          of_cell.push_back(cornerAt(256 * cell + x, 256 * 3 + y, 256 * 31 + z, 0));
        }
      }
      expected += countAll(of_cell);
      corners.insert(corners.end(), of_cell.begin(), of_cell.end());
    }
    const PairCounts counts = counted(corners);
    CHECK(counts == expected);
    all += counts;
    // Shuffles the triangles: without the order by cell, each triangle must be compared with all others near it.
    for (size_t t = corners.size() / 3; t-- > 1;) {
      const auto other = static_cast<size_t>(anyOf(random, static_cast<int32_t>(t + 1)));
      for (size_t k = 0; k < 3; ++k) std::swap(corners[3 * t + k], corners[3 * other + k]);
    }
    CHECK(counted(corners) == countAll(corners));
  }
  CHECK(all.folded > 20);
  CHECK(all.cut > 2000);
}

TEST_CASE("triangles of no body are left out, however large and many", "[faults]") {
  std::mt19937 random(1);
  std::vector<PairCorner> corners;
  for (int i = 0; i < 30000; ++i) {
    const auto place = [&] { return anyOf(random, 65536) - 32768; };
    const int x = place(), y = place(), z = place();
    corners.push_back(cornerAt(x, y, z, static_cast<uint16_t>(random())));
  }
  const PairCounts counts = counted(corners);
  CHECK(counts.folded == 0);
  CHECK(counted({}) == PairCounts{});
}
