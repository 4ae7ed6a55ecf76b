// Tests the index of many viewers: it gives the same results as examining all viewers.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "catch.h"
#include "mesh/chunk.h"
#include "rounds.h"
#include "stream/plan/viewer_index.h"

using namespace sgm;

namespace {

constexpr int32_t kCell = 512;

std::vector<Viewer> randomViewers(std::mt19937& random, size_t count, double spread) {
  const auto within = [&random](double most) { return std::uniform_real_distribution<>(-most, most)(random); };
  std::vector<Viewer> viewers(count);
  for (Viewer& viewer : viewers) {
    for (double& p : viewer.position) p = within(spread);
    if (random() % 2 == 0) {
      for (double& v : viewer.velocity) v = within(100.0 * kUnitsPerMetre);
    }
    if (random() % 2 == 0) {
      for (double& d : viewer.direction) d = within(1);
    }
    if (random() % 4 == 0) viewer.weight = std::exp(within(2));
    if (random() % 8 == 0) viewer.fov = 0.3;
    if (random() % 8 == 0) viewer.position = viewers.front().position;  // some viewers stand at the same place
  }
  return viewers;
}

/// Splits `node` and the nodes in it, as far as the viewers require this. Examines every viewer for every node, as a
/// reference for the index.
void splitWanted(Octree& tree, const ChunkKey& node, std::span<const LodViewer> viewers, const LodSettings& lod,
                 double near, const ChunkSet* finest) {
  if (node.level == 1 && finest != nullptr && !finest->contains(node)) return;
  const double own = node.level > lod.top ? lod.view_distance : std::ldexp(lod.finest_distance, node.level - 1);
  const double within = near > 0 ? near : own;
  const bool wanted = std::any_of(viewers.begin(), viewers.end(), [&](const LodViewer& viewer) {
    return distanceToChunk(viewer.position, node, lod.finest_cell) < within * viewer.reach;
  });
  if (!wanted || !tree.split(node) || node.level == 1) return;
  for (int i = 0; i < 8; ++i) splitWanted(tree, childOf(node, i), viewers, lod, near, finest);
}

}  // namespace

TEST_CASE("a chunk's urgency and distance are those of the viewer to whom they are least") {
  for (uint32_t seed = 1; seed <= rounds(60); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const double spread = std::ldexp(kUnitsPerMetre, static_cast<int>(random() % 12));
    const std::vector<Viewer> viewers = randomViewers(random, 1 + random() % 256, spread);
    LodSettings lod;
    lod.finest_cell = kCell;
    const double all_around = random() % 2 == 0 ? 0 : 16.0 * kUnitsPerMetre;
    const ViewerIndex index(viewers, lod, all_around);
    for (int i = 0; i < 100; ++i) {
      ChunkKey key;
      key.level = static_cast<int>(random() % 9);
      const double edge = std::ldexp(static_cast<double>(kChunkCells) * kCell, key.level);
      for (int axis = 0; axis < 3; ++axis) {
        key.at[axis] =
            static_cast<int32_t>(std::floor(std::uniform_real_distribution<>(-2 * spread, 2 * spread)(random) / edge));
      }
      double urgent = std::numeric_limits<double>::infinity(), away = urgent;
      for (const Viewer& viewer : viewers) {
        urgent = std::min(urgent, urgencyFor(key, SeenBy(viewer), lod, all_around));
        away = std::min(away, distanceToChunk(viewer.position, key, kCell));
      }
      REQUIRE(index.urgency(key) == urgent);
      REQUIRE(index.distance(key) == away);
    }
  }
  const ViewerIndex none({}, LodSettings{});
  CHECK(none.empty());
  CHECK(std::isinf(none.urgency({})));
  CHECK(std::isinf(none.distance({})));
}

TEST_CASE("the octree that many viewers want is what each of them asks for") {
  for (uint32_t seed = 1; seed <= rounds(20); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    LodSettings lod;
    lod.finest_cell = kCell;
    lod.top = static_cast<int>(random() % 6);
    lod.finest_distance = 24.0 * kUnitsPerMetre;
    // The view distance may be shorter than the distance at which viewers want the coarsest level.
    lod.view_distance = std::ldexp(kUnitsPerMetre, 5 + static_cast<int>(random() % 4));
    const std::vector<LodViewer> viewers =
        lodViewers(randomViewers(random, 1 + random() % 24, 300.0 * kUnitsPerMetre), lod);
    ChunkSet some;
    for (int i = 0; i < 3000; ++i) {
      const auto at = [&random] { return static_cast<int32_t>(random() % 24) - 12; };
      some.insert({1, {at(), at(), at()}});
    }
    const ChunkSet* const finest = random() % 2 == 0 ? &some : nullptr;
    for (const double near : {0.0, 16.0 * kUnitsPerMetre}) {
      Octree wanted(lod.top, kCell);
      const double edge = std::ldexp(static_cast<double>(kChunkCells) * kCell, lod.top + 1);
      const auto reach = static_cast<int32_t>(std::ceil(8000.0 * kUnitsPerMetre / edge));
      const auto roots = std::min(reach, 40);
      for (int32_t z = -roots; z < roots; ++z) {
        for (int32_t y = -roots; y < roots; ++y) {
          for (int32_t x = -roots; x < roots; ++x) {
            splitWanted(wanted, {lod.top + 1, {x, y, z}}, viewers, lod, near, finest);
          }
        }
      }
      refineToRules(wanted);
      const Octree found = near > 0 ? nearTarget(viewers, lod, near, finest) : lodTarget(viewers, lod, finest);
      // The expected tree was split only within the roots above. Compare it with the result only if all split nodes of
      // the result lie within these roots.
      bool inside = true;
      for (const ChunkKey& node : found.splitNodes()) {
        const int up = lod.top + 1 - node.level;
        for (int axis = 0; axis < 3; ++axis) {
          inside = inside && node.at[axis] >> up >= -roots + 1 && node.at[axis] >> up < roots - 1;
        }
      }
      if (inside) CHECK(found == wanted);
    }
  }
}
