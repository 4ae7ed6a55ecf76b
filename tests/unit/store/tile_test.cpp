// Tests that the tiles of a region contain each chunk once, and that the shards contain each tile once.

#include <set>

#include "catch.h"
#include "chunk/mesh_chunks.h"
#include "mesh/chunk.h"
#include "rounds.h"
#include "store/plan.h"

using namespace sgm;

namespace {

store::BakedRegion randomRegion(std::mt19937& random) {
  store::BakedRegion region;
  region.finest_cell = 1 + static_cast<int32_t>(random() % 700);
  region.first_level = static_cast<int>(random() % 3);
  region.last_level = region.first_level + static_cast<int>(random() % 4);
  for (int axis = 0; axis < 3; ++axis) {
    region.box.lo[axis] = static_cast<int32_t>(random() % 400000) - 200000;
    region.box.hi[axis] =
        region.box.lo[axis] + 1 + static_cast<int32_t>(random() % static_cast<uint32_t>(400 * region.finest_cell));
  }
  return region;
}

}  // namespace

TEST_CASE("a region's tiles have each of its chunks once", "[store]") {
  const auto seed = GENERATE(take(2, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  for (unsigned i = 0; i < rounds(50); ++i) {
    const store::BakedRegion region = randomRegion(random);
    REQUIRE(store::check(region));
    const std::vector<store::TileKey> tiles = store::tilesOf(region);
    CHECK(std::is_sorted(tiles.begin(), tiles.end()));
    std::set<ChunkKey> chunks;
    for (const store::TileKey& tile : tiles) {
      const std::vector<size_t> numbers = store::chunksIn(region, tile);
      CHECK(!numbers.empty());
      for (const size_t number : numbers) {
        const ChunkKey chunk = store::chunkOf(tile, number);
        CHECK(store::tileOf(chunk) == tile);
        CHECK(store::numberInTile(chunk) == number);
        CHECK(chunks.insert(chunk).second);
      }
    }
    // The tiles contain the right number of chunks.
    uint64_t count = 0;
    for (int level = region.first_level; level <= region.last_level; ++level)
      count += countChunks(region.box, int64_t{region.finest_cell} << level);
    CHECK(chunks.size() == count);
    for (const ChunkKey& chunk : chunks) {
      const int64_t edge = (int64_t{kChunkCells} * region.finest_cell) << chunk.level;
      for (int axis = 0; axis < 3; ++axis) {
        CHECK(chunk.at[axis] * edge < region.box.hi[axis]);
        CHECK((chunk.at[axis] + 1) * edge > region.box.lo[axis]);
      }
    }
  }
}

TEST_CASE("regions that cannot be baked say why", "[store]") {
  const IntBox box{{0, 0, 0}, {1024, 1024, 1024}};
  CHECK(store::check({box, 0, 3, 512}));
  CHECK(store::check({box, 3, 0, 512}).error().code == Code::invalid_argument);
  CHECK(store::check({box, 0, kMaxLevel + 1, 512}).error().code == Code::invalid_argument);
  CHECK(store::check({{{0, 0, 0}, {1024, 0, 1024}}, 0, 3, 512}).error().code == Code::invalid_argument);
  CHECK(store::check({box, 0, 3, 0}).error().code == Code::invalid_argument);
  CHECK(store::check({IntBox::everything(), 0, 3, 512}).error().code == Code::range);
  constexpr int32_t kOut = 1 << 30;
  CHECK(store::check({{{-kOut, -kOut, -kOut}, {kOut, kOut, kOut}}, 0, 3, 512}).error().code == Code::limit);
}

TEST_CASE("shards have each tile once, and none costs much more than its share", "[store]") {
  const auto seed = GENERATE(take(2, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  for (unsigned i = 0; i < rounds(200); ++i) {
    std::vector<uint64_t> costs(random() % 200);
    for (uint64_t& cost : costs) cost = random() % 3 == 0 ? random() % 100000 : random() % 50;
    const size_t shards = 1 + random() % 20;
    uint64_t all = 0, most = 0;
    for (const uint64_t cost : costs) all += cost + 1, most = std::max(most, cost + 1);
    size_t next = 0;
    for (size_t shard = 0; shard < shards; ++shard) {
      const auto [first, last] = store::tilesOfShard(costs, shard, shards);
      REQUIRE(first == next);
      REQUIRE(last >= first);
      next = last;
      uint64_t own = 0;
      for (size_t tile = first; tile < last; ++tile) own += costs[tile] + 1;
      CHECK(own <= all / shards + most + 1);
    }
    CHECK(next == costs.size());
  }
}
