// Tests the octree for a single picture: it satisfies the rules of octrees, and is as fine as the camera requires.

#include "stream/plan/view_target.h"

#include <cmath>
#include <random>

#include "catch.h"
#include "mesh/chunk.h"
#include "stream/plan/lod_target.h"

using namespace sgm;

namespace {

constexpr int32_t kFinest = 16;
constexpr int kTop = 4;

int64_t edgeOf(int level) { return int64_t{kChunkCells} * kFinest << level; }

PictureView randomView(std::mt19937& random, const IntBox& region) {
  std::uniform_real_distribution<double> part(-0.2, 1.2), side(-1, 1);
  PictureView view;
  for (size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    view.position[axis] = region.lo[a] + part(random) * (region.hi[a] - region.lo[a]);
    view.direction[axis] = side(random);
  }
  view.half_angle = 0.2 + 0.6 * std::abs(side(random));
  view.cell_angle = 0.002 * std::exp2(2 * side(random));
  return view;
}

/// The angle in radians between the camera's direction and the middle of a chunk.
double angleTo(const PictureView& view, const ChunkKey& chunk) {
  double along = 0, away = 0, length = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double d =
        (chunk.at[static_cast<int>(axis)] + 0.5) * static_cast<double>(edgeOf(chunk.level)) - view.position[axis];
    along += d * view.direction[axis];
    away += d * d;
    length += view.direction[axis] * view.direction[axis];
  }
  return std::acos(along / std::sqrt(away * length));
}

}  // namespace

TEST_CASE("a picture's octree keeps the rules, covers its region and has no cell in sight that looks too wide") {
  std::mt19937 random(20);
  for (int round = 0; round < 12; ++round) {
    CAPTURE(round);
    const auto edge = static_cast<int32_t>(edgeOf(kTop));
    IntBox region;
    for (int axis = 0; axis < 3; ++axis) {
      region.lo[axis] = (static_cast<int32_t>(random() % 9) - 4) * edge + static_cast<int32_t>(random() % 100);
      region.hi[axis] = region.lo[axis] + static_cast<int32_t>(1 + random() % 2) * edge;
    }
    const PictureView view = randomView(random, region);
    const Octree tree = viewTarget(view, region, kTop, kFinest);
    std::vector<BrokenRule> broken;
    for (const ChunkKey& node : tree.splitNodes()) findBrokenRules(tree, node, broken);
    CHECK(broken.empty());
    size_t fine = 0, coarse = 0;
    for (const ChunkKey& leaf : tree.leaves()) {
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis) {
        const int64_t low = leaf.at[axis] * edgeOf(leaf.level), high = low + edgeOf(leaf.level);
        inside &= low < region.hi[axis] && high > region.lo[axis];
      }
      if (!inside) continue;
      (leaf.level == 0 ? fine : coarse) += 1;
      const double cell = static_cast<double>(int64_t{kFinest} << leaf.level);
      const double wide = view.cell_angle * distanceToChunk(view.position, leaf, kFinest);
      if (leaf.level > 0 && angleTo(view, leaf) < view.half_angle) CHECK(cell <= wide);
      if (leaf.level > 0) CHECK(cell <= 4 * wide);
    }
    CHECK(fine + coarse > 0);
    // leafAt() returns the leaf that contains the place, for any place in the region.
    for (int i = 0; i < 100; ++i) {
      Int3 place;
      for (int axis = 0; axis < 3; ++axis) {
        const auto width = static_cast<uint32_t>(region.hi[axis] - region.lo[axis]);
        place[axis] = region.lo[axis] + static_cast<int32_t>(random() % width);
      }
      const ChunkKey leaf = tree.leafAt(place);
      CHECK(tree.isLeaf(leaf));
      for (int axis = 0; axis < 3; ++axis) CHECK(floorDiv(place[axis], edgeOf(leaf.level)) == leaf.at[axis]);
    }
  }
}

TEST_CASE("cells are halved until the nearest looks small enough, and no further than the finest") {
  PictureView view;
  view.cell_angle = 0.01;
  CHECK(halvingsFor(view, 64, 1, 100'000) == 0);
  CHECK(halvingsFor(view, 64, 1, 3200) == 1);
  CHECK(halvingsFor(view, 64, 1, 1000) == 3);
  CHECK(halvingsFor(view, 64, 20, 1000) == 1);
  CHECK(halvingsFor(view, 64, 1, 0) == 6);
}
