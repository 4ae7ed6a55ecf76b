// Tests regions whose chunks have several levels of detail: pictures of a world are made from such regions.

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "backend/open/open_backend.h"
#include "chunk/surface_shapes.h"
#include "mesh/check.h"
#include "mesh/chunk.h"
#include "region/region_mesh.h"
#include "region/region_texture.h"
#include "stream/plan/view_target.h"
#include "world/world_support.h"

using namespace sgm;

namespace {

/// Number of edges with only one triangle that do not lie in the outer faces of the region.
size_t holesIn(const WorldMesh& mesh, const IntBox& extent) {
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) edges.emplace_back(mesh.indices[i + k], mesh.indices[i + (k + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  const auto onBorder = [&](uint32_t vertex) {
    for (int axis = 0; axis < 3; ++axis) {
      const double place = mesh.positions[vertex][static_cast<size_t>(axis)] * kUnitsPerMetre + mesh.origin[axis];
      if (std::abs(place - extent.lo[axis]) < 1e-6 || std::abs(place - extent.hi[axis]) < 1e-6) return true;
    }
    return false;
  };
  size_t holes = 0;
  for (const auto& [a, b] : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), std::pair(b, a))) holes += !onBorder(a) || !onBorder(b);
  }
  return holes;
}

}  // namespace

TEST_CASE("a region of several levels has no open edge inside, plain and sharp", "[threads]") {
  const IntBox hall{{64 * 1024, 64 * 1024, 64 * 1024}, {112 * 1024, 112 * 1024, 112 * 1024}};
  const std::unique_ptr<JobSystem> jobs = *makeThreadPool(2);
  const WorldField world(settingsOf(yardstick("cave.sgm"), 128), std::pmr::get_default_resource());
  const Result<std::unique_ptr<Backend>> backend = makeBackend({}, *jobs, world.memory());
  REQUIRE(backend);
  constexpr int kTop = 3;
  std::mt19937 random(7);
  for (int round = 0; round < 4; ++round) {
    CAPTURE(round);
    PictureView view;
    for (size_t axis = 0; axis < 3; ++axis)
      view.position[axis] = static_cast<double>(hall.lo[0] + static_cast<int32_t>(random() % (48 * 1024)));
    view.half_angle = 3.2;  // radians, more than pi: the view covers all directions
    view.cell_angle = 0.012 + 0.003 * round;
    const Octree tree = viewTarget(view, hall, kTop, world.cellAt(0));
    const bool sharp = round % 2 == 1;
    Result<RegionMesh> region = meshRegion(world, **backend, *jobs, hall, tree, 100'000, sharp);
    REQUIRE(region);
    REQUIRE(region->mesh.indices.size() > 3000);
    CHECK(holesIn(region->mesh, region->extent) == 0);
    const MeshReport report = checkTriangles(region->mesh.indices, region->mesh.positions.size());
    INFO(describe(report));
    CHECK(report.manifold());

    // The callback returns the octree leaf that contains a place; unwrapRegion() uses it to take the materials of each
    // vertex from its own level of detail.
    std::vector<bool> levels(kTop + 1);
    const Result<TexturedRegion> textured = unwrapRegion(
        world, *jobs, region->mesh,
        [&](Int3 place) {
          const ChunkKey leaf = tree.leafAt(place);
          levels[static_cast<size_t>(leaf.level)] = true;
          return leaf;
        },
        kTile);
    REQUIRE(textured);
    CHECK(textured->unwrapped.corners.size() == region->mesh.indices.size());
    CHECK(std::count(levels.begin(), levels.end(), true) >= 2);

    const Result<RegionMesh> few = meshRegion(world, **backend, *jobs, hall, tree, region->chunks - 1, sharp);
    REQUIRE_FALSE(few);
    CHECK(few.error().code == Code::limit);
  }
}
