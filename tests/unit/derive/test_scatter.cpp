#include <algorithm>
#include <cmath>

#include "catch.h"
#include "derive/layout/scatter.h"

using namespace sgm;

namespace {

/// All points that are scattered in a box of grammar cells, as world positions.
std::vector<Int3> gather(const Lattice& lattice, Int3 from, Int3 to, int32_t radius) {
  std::vector<Int3> all;
  for (int z = from.z; z < to.z; ++z) {
    for (int y = from.y; y < to.y; ++y) {
      for (int x = from.x; x < to.x; ++x) {
        const auto points = poissonInCell(lattice, {x, y, z}, PathKey{42}, radius, 1u << 20);
        REQUIRE(points);
        for (const LatticePoint& p : *points) {
          all.push_back(saturatingAdd({x * lattice.size.x, y * lattice.size.y, z * lattice.size.z}, p.offset));
        }
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

TEST_CASE("poisson points keep their distance across cell borders") {
  const int32_t radius = 2253;
  const Lattice lattice{1, {6000, 5000, 7001}};
  const std::vector<Int3> points = gather(lattice, {-2, -1, -2}, {2, 2, 1}, radius);
  REQUIRE(points.size() > 100);
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      double square = 0;
      for (int a = 0; a < 3; ++a) square += std::pow(static_cast<double>(points[i][a]) - points[j][a], 2);
      REQUIRE(square >= static_cast<double>(radius) * radius);
    }
  }
  // Expected number of points in a cube with the edge `radius`, if each such cube has one candidate: (1 - exp(-4/3 pi))
  // / (4/3 pi) = 0.235.
  const double cubes = 4 * 6000.0 * 3 * 5000.0 * 3 * 7001.0 / std::pow(radius, 3.0);
  CHECK(static_cast<double>(points.size()) / cubes > 0.2);
  CHECK(static_cast<double>(points.size()) / cubes < 0.3);
}

TEST_CASE("the poisson set does not depend on how the world is cut into cells") {
  const Lattice coarse{1, {12000, 12000, 12000}}, fine{1, {3000, 4000, 6000}};
  REQUIRE(gather(coarse, {-1, -1, -1}, {1, 1, 1}, 1500) == gather(fine, {-4, -3, -2}, {4, 3, 2}, 1500));
}

TEST_CASE("poisson points of a plane lattice lie in the plane") {
  const Lattice lattice{1, {8000, 0, 8000}};
  const auto points = poissonInCell(lattice, {-3, 0, 2}, PathKey{1}, 700, 1u << 20);
  REQUIRE(points);
  REQUIRE(points->size() > 20);
  for (const LatticePoint& p : *points) REQUIRE(p.offset.y == 0);
}

TEST_CASE("too many poisson candidates are refused, not computed") {
  REQUIRE_FALSE(poissonInCell({1, {1 << 30, 1 << 30, 1 << 30}}, {}, PathKey{1}, 1, 1u << 20));
}

TEST_CASE("points on a shell lie on the asked part of the sphere") {
  const std::vector<Vec3> points = scatterOnShell(PathKey{3}, 500, 7.0, 0.6);
  REQUIRE(points.size() == 500);
  double lowest = 7;
  for (const Vec3& p : points) {
    REQUIRE(length(p) == Approx(7.0));
    lowest = std::min(lowest, p.y);
  }
  CHECK(lowest >= 7.0 * (1 - 2 * 0.6) - 1e-9);
  CHECK(lowest < -1.2);
}

TEST_CASE("points in a box and on a disc stay inside") {
  for (const Vec3& p : scatterInBox(PathKey{3}, 200, {2, 4, 6})) {
    REQUIRE(std::abs(p.x) <= 1);
    REQUIRE(std::abs(p.y) <= 2);
    REQUIRE(std::abs(p.z) <= 3);
  }
  for (const Vec3& p : scatterOnDisc(PathKey{3}, 200, 5)) {
    REQUIRE(p.y == 0);
    REQUIRE(length(p) <= 5);
  }
}

TEST_CASE("thinned points keep their distance and leave no room") {
  const std::vector<Vec3> points = scatterInBox(PathKey{9}, 300, {4, 4, 4});
  const std::vector<size_t> kept = thinned(PathKey{10}, points, 1.0);
  REQUIRE(kept.size() > 10);
  for (size_t i : kept) {
    for (size_t j : kept) {
      if (i != j) REQUIRE(length(points[i] - points[j]) >= 1.0);
    }
  }
}
