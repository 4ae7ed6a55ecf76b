// Good meshes pass, and every kind of damage is found in each of a hundred meshes.

#include "measure/mesh_measures.h"

#include <memory>

#include "../catch.h"
#include "../rounds.h"
#include "defects.h"

namespace sgm::measure {
namespace {

MeshMeasures measured(const Mesh& mesh, const MeshSettings& settings = {}) {
  const auto jobs = std::move(*makeThreadPool(2));
  return *measureMesh(mesh, settings, *jobs);
}

}  // namespace

TEST_CASE("a thousand good meshes raise no alarm", "[measures]") {
  for (unsigned seed = 0; seed < rounds(1000); ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = goodMesh(random);
    const MeshMeasures found = measured(mesh);
    CAPTURE(seed, mesh.triangles.size(), describe(found.identity), found.self_intersections->pairs, found.nesting.inside_out);
    CHECK(found.watertight());
    CHECK(found.valid());
    CHECK(found.degenerate() == 0);
    CHECK(found.genus().has_value());
    CHECK(found.sums.volume > 0);
    CHECK(found.welded_points == 0);
  }
}

TEST_CASE("each kind of damage is found in each of a hundred meshes", "[measures]") {
  for (const Defect& defect : defects()) {
    unsigned missed = 0;
    for (unsigned seed = 0; seed < rounds(100); ++seed) {
      std::mt19937 random(seed);
      Mesh mesh = goodMesh(random);
      defect.make(mesh, random);
      const MeshMeasures found = measured(mesh);
      const bool told = defect.found(found) && !found.valid();
      CAPTURE(defect.name, seed, mesh.triangles.size(), describe(found.identity));
      CHECK(told);
      missed += !told;
    }
    CHECK(missed == 0);
  }
}

TEST_CASE("shells that face inward are cavities within a solid, and inside out elsewhere", "[measures]") {
  Mesh mesh = ball(3).moved([](Point p) { return 3.0 * p; });
  Mesh hollow = ball(2).at({1, 0, 0});
  hollow.invert();
  mesh.add(hollow);
  MeshMeasures found = measured(mesh);
  CHECK(found.nesting.cavities == 1);
  CHECK(found.nesting.inside_out == 0);
  CHECK(found.valid());
  CHECK(found.parts.objects == 2);

  mesh.add(hollow.at({10, 0, 0}));
  found = measured(mesh);
  CHECK(found.nesting.cavities == 1);
  CHECK(found.nesting.inside_out == 1);
  CHECK_FALSE(found.valid());
}

TEST_CASE("files repeat points, and have some that nothing uses", "[measures]") {
  Mesh soup;
  for (const Triangle& t : torus(8).triangles) {
    for (const uint32_t v : t) soup.points.push_back(torus(8).points[v]);
    const auto n = static_cast<uint32_t>(soup.points.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  soup.points.push_back({std::nan(""), 0, 0});
  const MeshMeasures found = measured(soup);
  CHECK(found.valid());
  CHECK(found.genus() == 1u);
  CHECK(found.euler() == 0);
  CHECK(found.points == 3 * 128 + 1);
  CHECK(found.unused_points == 1);
  CHECK(found.welded_points == 3 * 128 - 64);
}

TEST_CASE("nothing is measured as nothing", "[measures]") {
  const MeshMeasures found = measured({});
  CHECK(found.watertight());
  CHECK(found.sums.area == 0);
  CHECK(found.parts.objects == 0);
  CHECK(found.genus() == 0u);
  CHECK(found.histogram.edges == 0);
}

TEST_CASE("measures are the same for any number of threads", "[measures]") {
  std::mt19937 random(5);
  Mesh mesh = torus(60);
  mesh.add(randomSurface(random, 12));
  MeshSettings settings;
  settings.cubes = 0.3;
  const auto with = [&](unsigned n) { return *measureMesh(mesh, settings, **makeThreadPool(n)); };
  const MeshMeasures one = with(1);
  for (const unsigned n : {2u, 4u}) {
    const MeshMeasures other = with(n);
    CHECK(other.sums.area == one.sums.area);
    CHECK(other.sums.volume == one.sums.volume);
    CHECK(other.histogram.shares == one.histogram.shares);
    CHECK(other.self_intersections->pairs == one.self_intersections->pairs);
    CHECK(other.self_intersections->examples == one.self_intersections->examples);
    CHECK(other.cubes->centre == one.cubes->centre);
  }
  CHECK(one.self_intersections->pairs > 0);
}

}  // namespace sgm::measure
