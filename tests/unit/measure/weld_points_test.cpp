// Tests that exactly the points which should be merged are merged.

#include "measure/weld_points.h"

#include <algorithm>

#include "../catch.h"
#include "../rounds.h"
#include "shapes.h"

namespace sgm::measure {
namespace {

/// Gives every triangle of the mesh its own points.
Mesh soupOf(const Mesh& mesh) {
  Mesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<uint32_t>(soup.points.size());
    for (const uint32_t v : t) soup.points.push_back(mesh.points[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

}  // namespace

TEST_CASE("a soup of triangles becomes the mesh that it was", "[weld]") {
  for (unsigned seed = 0; seed < rounds(20); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const Mesh mesh = placed(randomSurface(random, 6), random, 1, 1e5);
    if (mesh.triangles.empty()) continue;
    const Mesh soup = soupOf(mesh);
    const WeldedPoints welded = weldPoints(soup);
    CHECK(welded.points.size() == mesh.points.size());
    CHECK(welded.merged == soup.points.size() - mesh.points.size());
    REQUIRE(welded.triangles.size() == mesh.triangles.size());
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (size_t k = 0; k < 3; ++k) CHECK(welded.points[welded.triangles[i][k]] == mesh.points[mesh.triangles[i][k]]);
    }
  }
}

TEST_CASE("without a tolerance neighbours stay apart, and zeroes of both signs are one", "[weld]") {
  const double next = std::nextafter(1.0, 2.0);
  const std::vector<Point> points{{0.0, 1, 2}, {-0.0, 1, 2}, {0, next, 2}, {7, 7, 7}};
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const WeldedPoints welded = weldPoints({points, triangles});
  CHECK(welded.points.size() == 2);
  CHECK(welded.merged == 1);
  CHECK(welded.triangles[0] == Triangle{0, 0, 1});
}

TEST_CASE("with a tolerance each point falls on the first one near it", "[weld]") {
  size_t merged = 0;
  for (unsigned seed = 0; seed < std::max(rounds(200), 100u); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const double tolerance = std::ldexp(1, static_cast<int>(random() % 20) - 10);
    const double reach = tolerance * between(random, 1, 8), far = random() % 2 == 0 ? 0 : 1e3 * tolerance;
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    for (uint32_t i = 0; i < 60; ++i) {
      const auto along = [&] {
        // Some points lie exactly on the lines of the search grid, or exactly the tolerance apart.
        const double v = random() % 3 == 0 ? tolerance * static_cast<double>(random() % 8) : between(random, 0, reach);
        return v - far;
      };
      points.push_back({along(), along(), along()});
      if (i % 3 == 2) triangles.push_back({i - 2, i - 1, i});
    }
    const WeldedPoints welded = weldPoints({points, triangles}, tolerance);
    std::vector<Point> kept;
    for (size_t i = 0; i < points.size(); ++i) {
      size_t at = 0;
      while (at < kept.size() && length(kept[at] - points[i]) > tolerance) ++at;
      if (at == kept.size()) kept.push_back(points[i]);
      CHECK(welded.triangles[i / 3][i % 3] == at);
    }
    CHECK(std::equal(welded.points.begin(), welded.points.end(), kept.begin(), kept.end()));
    CHECK(welded.merged == points.size() - kept.size());
    merged += welded.merged;
  }
  CHECK(merged > 100);
}

TEST_CASE("a millionth of the diagonal would merge what a mesh of ours keeps apart", "[weld]") {
  // Three vertices near a common corner of 0.25 m cells, each on a different edge at 1/256 of its length, in a region
  // of 2 km.
  const double off = 0.25 / 256;
  const std::vector<Point> points{{off, 0, 0}, {0, off, 0}, {0, 0, off}, {2000, 0, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 1, 3}};
  CHECK(weldPoints({points, triangles}, 1e-6 * 2000).points.size() < 4);
  CHECK(weldPoints({points, triangles}).points.size() == 4);
}

}  // namespace sgm::measure
