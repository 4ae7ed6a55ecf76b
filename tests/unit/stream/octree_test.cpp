// Tests the octree's two rules, the octree for a set of viewers, and the steps from one octree to another.

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "catch.h"
#include "mesh/chunk.h"
#include "rounds.h"
#include "stream/plan/commit_plan.h"
#include "stream/plan/lod_target.h"

using namespace sgm;

namespace {

constexpr int kTop = 4;
constexpr int32_t kCell = 256;

/// Level of the leaf that covers a level-0 chunk; kTop + 1 if no leaf does. It is computed without the functions by
/// which the octree itself checks its rules.
int levelAt(const Octree& tree, Int3 at) {
  int level = kTop + 1;
  while (level > 0 && tree.isSplit({level, {at.x >> level, at.y >> level, at.z >> level}})) --level;
  return level;
}

/// Number of places in a box at which a rule of octrees is broken: tests every pair of neighbours and every edge of
/// level-0 chunks.
size_t brokenPlaces(const Octree& tree, int32_t extent) {
  const int32_t side = 2 * extent + 2;
  std::vector<int> levels;
  for (int32_t z = -extent; z < extent + 2; ++z) {
    for (int32_t y = -extent; y < extent + 2; ++y) {
      for (int32_t x = -extent; x < extent + 2; ++x) levels.push_back(levelAt(tree, {x, y, z}));
    }
  }
  const size_t step[] = {1, static_cast<size_t>(side), static_cast<size_t>(side) * static_cast<size_t>(side)};
  size_t broken = 0;
  for (int32_t z = 0; z + 1 < side; ++z) {
    for (int32_t y = 0; y + 1 < side; ++y) {
      for (int32_t x = 0; x + 1 < side; ++x) {
        const size_t at = static_cast<size_t>(x + side * (y + side * z));
        for (size_t axis = 0; axis < 3; ++axis) {
          const size_t u = step[(axis + 1) % 3], v = step[(axis + 2) % 3];
          const int here = levels[at], a = levels[at + u], b = levels[at + v], c = levels[at + u + v];
          broken += std::abs(here - a) > 1;
          // At an edge, two diagonally opposite leaves must not both be finer than the other two.
          broken += std::max(here, c) < std::min(a, b) || std::max(a, b) < std::min(here, c);
        }
      }
    }
  }
  return broken;
}

Octree randomTree(std::mt19937& random) {
  Octree tree(kTop, kCell);
  const int splits = 1 + static_cast<int>(random() % 12);
  for (int i = 0; i < splits; ++i) {
    const int level = 1 + static_cast<int>(random() % (kTop + 1));
    const int32_t extent = 16 >> (level - 1);
    const auto place = [&] { return static_cast<int32_t>(random() % static_cast<uint32_t>(2 * extent)) - extent; };
    const int32_t x = place(), y = place(), z = place();
    tree.split({level, {x, y, z}});
  }
  refineToRules(tree);
  return tree;
}

bool ready(const Octree& tree, const Readiness& readiness) {
  const std::vector<ChunkKey> leaves = tree.leaves();
  return std::all_of(leaves.begin(), leaves.end(), [&](const ChunkKey& leaf) {
    return readiness.body(leaf) && (coarserFaces(tree, leaf) & ~readiness.seams(leaf)) == 0;
  });
}

void makeReady(const Octree& tree, std::map<ChunkKey, uint8_t>& chunks) {
  for (const ChunkKey& leaf : tree.leaves()) chunks[leaf] |= coarserFaces(tree, leaf);
}

Readiness readinessOf(const std::map<ChunkKey, uint8_t>& chunks) {
  return {[&](const ChunkKey& key) { return chunks.contains(key); },
          [&](const ChunkKey& key) {
            const auto found = chunks.find(key);
            return found == chunks.end() ? uint8_t{0} : found->second;
          }};
}

}  // namespace

TEST_CASE("random octrees refined to the rules keep them, and keep what was asked for") {
  for (uint32_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const Octree tree = randomTree(random);
    CHECK(brokenPlaces(tree, 40) == 0);
    std::vector<BrokenRule> broken;
    for (const ChunkKey& node : tree.splitNodes()) {
      findBrokenRules(tree, node, broken);
      REQUIRE((node.level > kTop || tree.isSplit(parentOf(node))));
    }
    CHECK(broken.empty());
  }
}

TEST_CASE("leaves cover each place once, in one order") {
  std::mt19937 random(3);
  const Octree tree = randomTree(random);
  const std::vector<ChunkKey> leaves = tree.leaves();
  std::set<ChunkKey> unique(leaves.begin(), leaves.end());
  CHECK(unique.size() == leaves.size());
  int64_t volume = 0, expected = 0;
  for (const ChunkKey& leaf : leaves) {
    REQUIRE(tree.isLeaf(leaf));
    volume += int64_t{1} << 3 * leaf.level;
  }
  for (const ChunkKey& node : tree.splitNodes()) {
    if (node.level == kTop + 1) expected += int64_t{1} << 3 * node.level;
  }
  CHECK(volume == expected);
}

TEST_CASE("a broken rule is seen: a face two levels apart, and a checkerboard around an edge") {
  Octree face(kTop, kCell);
  face.split({2, {0, 0, 0}});
  CHECK(brokenPlaces(face, 20) > 0);
  std::vector<BrokenRule> broken;
  findBrokenRules(face, {2, {0, 0, 0}}, broken);
  CHECK_FALSE(broken.empty());

  Octree edge(kTop, kCell);
  edge.split({3, {1, 1, 1}});
  edge.split({3, {0, 0, 1}});
  CHECK(brokenPlaces(edge, 20) > 0);
  broken.clear();
  findBrokenRules(edge, {3, {1, 1, 1}}, broken);
  REQUIRE_FALSE(broken.empty());
  CHECK(broken.back().across == ChunkKey{3, {0, 0, 1}});
}

TEST_CASE("what viewers want is fine near them, reaches as far as asked, and keeps the rules at the world's end") {
  for (uint32_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const bool at_end = seed % 3 == 0;
    std::vector<LodViewer> viewers(1 + random() % 3);
    for (LodViewer& viewer : viewers) {
      for (double& p : viewer.position) {
        p = at_end ? (random() % 2 ? 2147483647.0 : -2147483648.0)
                   : std::uniform_real_distribution<>(-2e5, 2e5)(random);
      }
    }
    LodSettings settings;
    settings.top = kTop;
    settings.finest_cell = kCell;
    settings.finest_distance = 24 * 1024.0;
    settings.view_distance = 600 * 1024.0;
    const Octree tree = lodTarget(viewers, settings);
    std::vector<BrokenRule> broken;
    for (const ChunkKey& node : tree.splitNodes()) findBrokenRules(tree, node, broken);
    CHECK(broken.empty());
    CHECK_FALSE(tree.empty());
    for (const ChunkKey& leaf : tree.leaves()) {
      const int64_t edge = int64_t{kChunkCells} * kCell << leaf.level;
      for (int axis = 0; axis < 3; ++axis) {
        REQUIRE(leaf.at[axis] * edge >= INT32_MIN);
        REQUIRE((leaf.at[axis] + 1) * edge <= INT32_MAX);
      }
      if (at_end) continue;
      for (const LodViewer& viewer : viewers) {
        const double d = distanceToChunk(viewer.position, leaf, kCell);
        if (leaf.level > 0) REQUIRE(d >= std::ldexp(settings.finest_distance, leaf.level - 1));
      }
    }
    if (at_end) continue;
    for (const LodViewer& viewer : viewers) {
      for (int i = 0; i < 50; ++i) {
        Int3 at;
        for (int axis = 0; axis < 3; ++axis) {
          const double p = viewer.position[static_cast<size_t>(axis)] +
                           std::uniform_real_distribution<>(-0.57, 0.57)(random) * settings.view_distance;
          at[axis] = static_cast<int32_t>(std::floor(p / (kChunkCells * kCell)));
        }
        REQUIRE(levelAt(tree, at) <= kTop);
      }
    }
  }
  CHECK(lodTarget({}, LodSettings{}).empty());
}

TEST_CASE("a step keeps the rules and draws nothing that is not ready, whatever is ready") {
  int whole = 0, partial = 0;
  for (uint32_t seed = 1; seed <= rounds(100); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Octree committed = randomTree(random);
    std::map<ChunkKey, uint8_t> chunks;
    makeReady(committed, chunks);
    const Octree target = randomTree(random);
    std::map<ChunkKey, uint8_t> wanted;
    makeReady(target, wanted);
    // Chunks of intermediate nodes and some additional seams become ready as well, all in random order.
    for (const ChunkKey& node : target.splitNodes()) {
      if (node.level <= kTop && random() % 2) wanted[node] |= static_cast<uint8_t>(random() % 64);
    }
    std::vector<std::pair<ChunkKey, uint8_t>> coming(wanted.begin(), wanted.end());
    std::shuffle(coming.begin(), coming.end(), random);
    for (size_t done = 0; done < coming.size();) {
      const CommitPlan plan = planCommit(committed, target, readinessOf(chunks));
      std::vector<BrokenRule> broken;
      for (const ChunkKey& node : plan.tree.splitNodes()) {
        REQUIRE((node.level > kTop || plan.tree.isSplit(parentOf(node))));
        findBrokenRules(plan.tree, node, broken);
      }
      REQUIRE(broken.empty());
      REQUIRE(ready(plan.tree, readinessOf(chunks)));
      (plan.tree == target ? whole : partial) += 1;
      if (random() % 3 == 0) committed = plan.tree;
      for (size_t some = 1 + random() % (1 + coming.size() / 12); some > 0 && done < coming.size(); --some, ++done) {
        chunks[coming[done].first] |= coming[done].second;
      }
    }
    CHECK(planCommit(committed, target, readinessOf(chunks)).tree == target);
  }
  CHECK(whole > 0);
  CHECK(partial > whole);
}

TEST_CASE("a seam that is missing is named, and keeps its step back") {
  Octree committed(kTop, kCell), target(kTop, kCell);
  committed.split({kTop + 1, {0, 0, 0}});
  target.split({kTop + 1, {0, 0, 0}});
  std::map<ChunkKey, uint8_t> chunks;
  makeReady(committed, chunks);
  target.split({kTop + 1, {1, 0, 0}});
  makeReady(target, chunks);
  const ChunkKey lacking{kTop, {2, 0, 0}};
  chunks[lacking] = 0;
  const CommitPlan plan = planCommit(committed, target, readinessOf(chunks));
  CHECK(plan.tree == committed);
  REQUIRE(plan.missing.size() == 1);
  CHECK(plan.missing[0].chunk == lacking);
  CHECK(plan.missing[0].faces == coarserFaces(target, lacking));
}
