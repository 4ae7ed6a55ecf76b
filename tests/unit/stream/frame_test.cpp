// Tests that the surface of any drawn octree is closed: its bodies, its seams between levels with different fields, and
// its outer faces.

#include <algorithm>
#include <random>

#include "catch.h"
#include "mesh/check.h"
#include "rounds.h"
#include "stream/plan/frame.h"
#include "stream/plan/lod_target.h"
#include "world/world_support.h"

using namespace sgm;

namespace {

Octree randomTreeAround(std::mt19937& random, Int3 centre, int top, int32_t cell) {
  Octree tree(top, cell);
  const auto place = [&](int level, int axis) {
    const int64_t edge = int64_t{kChunkCells} * cell << level;
    const int32_t at = static_cast<int32_t>(floorDiv(centre[axis], edge));
    const int spread = std::max(1, 4 >> level);
    return at + static_cast<int32_t>(random() % static_cast<uint32_t>(2 * spread + 1)) - spread;
  };
  for (int i = 0; i < 5; ++i) {
    const int level = 1 + static_cast<int>(random() % static_cast<uint32_t>(top + 1));
    const int32_t x = place(level, 0), y = place(level, 1), z = place(level, 2);
    tree.split({level, {x, y, z}});
  }
  refineToRules(tree);
  return tree;
}

std::vector<const MeshPart*> drawnParts(const std::pmr::vector<PlacedChunk>& chunks) {
  std::vector<PlacedPart> placed;
  for (const PlacedChunk& chunk : chunks) appendParts(chunk, placed);
  std::vector<const MeshPart*> parts;
  for (const PlacedPart& part : placed) parts.push_back(part.mesh);
  return parts;
}

}  // namespace

TEST_CASE("random octrees of a cave and of a cloud are closed in every vertex") {
  struct Scene {
    const char* grammar;
    Int3 centre;
    int32_t cell;
  };
  // At these cell sizes, coarse levels omit the cave's stalactites and octaves of noise, so the levels' fields differ.
  const Scene scenes[] = {{"cave.sgm", {96 * 1024, 96 * 1024, 96 * 1024}, 128},
                          {"cloud.sgm", {450 * 1024, 1200 * 1024, 450 * 1024}, 4096}};
  for (const Scene& scene : scenes) {
    const WorldField world(settingsOf(yardstick(scene.grammar), scene.cell, 3), std::pmr::get_default_resource());
    size_t triangles = 0, seams = 0;
    for (uint32_t seed = 1; seed <= rounds(2); ++seed) {
      CAPTURE(scene.grammar, seed);
      std::mt19937 random(seed);
      const Octree tree = randomTreeAround(random, scene.centre, 3, scene.cell);
      const std::pmr::vector<PlacedChunk> chunks = meshAll(world, frameRequests(tree), 2);
      const MeshReport report = checkParts(drawnParts(chunks));
      INFO(describe(report));
      CHECK(report.closed());
      triangles += report.triangles;
      for (const PlacedChunk& chunk : chunks) {
        for (const MeshPart& seam : chunk.mesh.seams) seams += seam.indices.size() / 3;
      }
    }
    CHECK(triangles > 1000);
    CHECK(seams > 100);
  }
}

TEST_CASE("a frame without one of its seams is seen to be open") {
  const WorldField world(settingsOf(yardstick("cave.sgm"), 128, 3), std::pmr::get_default_resource());
  std::mt19937 random(5);
  const Octree tree = randomTreeAround(random, {96 * 1024, 96 * 1024, 96 * 1024}, 3, 128);
  std::pmr::vector<PlacedChunk> chunks = meshAll(world, frameRequests(tree), 2);
  int left_out = 0;
  for (PlacedChunk& chunk : chunks) {
    for (MeshPart& seam : chunk.mesh.seams) {
      if (seam.indices.empty() || left_out == 5) continue;
      const RawVector<uint32_t> kept = seam.indices;
      seam.indices.clear();
      CHECK_FALSE(checkParts(drawnParts(chunks)).closed());
      seam.indices = kept;
      ++left_out;
    }
  }
  CHECK(left_out == 5);
  CHECK(checkParts(drawnParts(chunks)).closed());
}

TEST_CASE("what viewers want of an endless world is closed, near the origin and far from it") {
  for (const int32_t far : {0, 1'500'000 * 1024}) {
    CAPTURE(far);
    // The layer of stalactites is removed, because a coarse chunk would contain hundreds of thousands of its small
    // cells.
    const std::string text =
        replaced(yardstick("cave.sgm"), "layer drip cell 24m reach 5m uses net { start Drips; }", "");
    const WorldField world(settingsOf(text, 256, 3), std::pmr::get_default_resource());
    LodSettings lod;
    lod.top = 6;
    lod.finest_cell = 256;
    lod.finest_distance = 16 * 1024.0;
    lod.view_distance = 600 * 1024.0;
    const LodViewer viewer{{far + 96 * 1024.0, 96 * 1024.0, 96 * 1024.0}, 1};
    const Octree tree = lodTarget(std::span(&viewer, 1), lod);
    const std::pmr::vector<PlacedChunk> chunks = meshAll(world, frameRequests(tree), 2);
    const MeshReport report = checkParts(drawnParts(chunks));
    INFO(describe(report));
    CHECK(report.closed());
    CHECK(report.triangles > 1000);
  }
}
