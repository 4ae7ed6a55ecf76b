// Tests the cache of derived cells: each is derived once, and unused ones are discarded first.

#include "world/cell_cache.h"
#include "seed.h"

#include <algorithm>
#include <atomic>
#include <random>

#include "base/jobs.h"
#include "catch.h"
#include "rounds.h"

using namespace sgm;

namespace {

Result<GrammarChunk> nothing() { return GrammarChunk{}; }
CellKey keyOf(int32_t i) { return {0, {i, 0, 0}}; }
bool has(CellCache& cache, int32_t i) {
  std::vector<std::shared_ptr<const DerivedCell>> found;
  const CellKey keys[] = {keyOf(i)};
  cache.find(keys, found);
  return found[0] != nullptr;
}

/// A cache whose capacity is `cells` cells without shapes.
CellCache cacheOf(size_t cells) {
  return CellCache(cells * DerivedCell(GrammarChunk{}, std::pmr::get_default_resource()).bytes,
                   std::pmr::get_default_resource());
}

}  // namespace

TEST_CASE("a cell asked for by many threads is derived once, and a failed one is not kept", "[threads]") {
  CellCache cache(1 << 20, std::pmr::get_default_resource());
  const auto jobs = *makeThreadPool(8);
  std::atomic<int> derived{0};
  parallelFor(*jobs, 64, [&](size_t i) {
    const auto cell = cache.get({0, {static_cast<int32_t>(i % 4), 0, 0}}, [&]() -> Result<GrammarChunk> {
      ++derived;
      return GrammarChunk{};
    });
    if (!cell) throw std::runtime_error("no cell");
  });
  CHECK(derived == 4);
  CHECK(cache.stats().cells == 4);

  const CellKey bad{1, {}};
  CHECK_FALSE(cache.get(bad, []() -> Result<GrammarChunk> { return Error{Code::limit, "too much"}; }));
  CHECK_THROWS(cache.get(bad, []() -> Result<GrammarChunk> { throw std::bad_alloc(); }));
  CHECK(cache.get(bad, []() -> Result<GrammarChunk> { return GrammarChunk{}; }));
}

TEST_CASE("cells that were asked for outlive those that were not, and the one that came stays") {
  CellCache cache = cacheOf(3);
  for (const int32_t i : {0, 1, 2}) REQUIRE(cache.get(keyOf(i), nothing));
  REQUIRE(cache.get(keyOf(0), nothing));
  REQUIRE(cache.get(keyOf(3), nothing));
  CHECK(has(cache, 0));
  CHECK_FALSE(has(cache, 1));
  CHECK(has(cache, 3));
  CHECK(cache.stats().cells == 3);
  CHECK(cache.stats().evicted == 1);
}

TEST_CASE("cells that nobody asks for any more go before the cache is full, down to a quarter of it") {
  for (const size_t room : {size_t{2000}, size_t{8000}}) {
    CAPTURE(room);
    CellCache cache = cacheOf(room);
    for (int32_t i = 0; i < 30'000; ++i) {
      REQUIRE(cache.get(keyOf(i), nothing));
      REQUIRE(has(cache, 0));
    }
    // The cache keeps the cells that were used last (1,024, or a quarter of its capacity if that is more), and the cell
    // that is used all the time.
    const size_t kept = std::max<size_t>(1025, room / 4);
    CHECK(cache.stats().cells >= kept);
    CHECK(cache.stats().cells <= kept + 2);
    CHECK_FALSE(has(cache, 1));
    CHECK(has(cache, 29'500));
  }
  CellCache cache = cacheOf(100'000);
  for (int32_t i = 0; i < 24'000; ++i) REQUIRE(cache.get(keyOf(i), nothing));
  CHECK(has(cache, 1));  // the cell's size is below a quarter of the limit
}

TEST_CASE("a cell larger than the cache comes, and goes with the next") {
  CellCache cache(1, std::pmr::get_default_resource());
  for (const int32_t i : {0, 1}) {
    REQUIRE(cache.get(keyOf(i), nothing));
    CHECK(has(cache, i));
    CHECK(cache.stats().cells == 1);
  }
}

TEST_CASE("adopted cells that were asked for outlive those that were not") {
  CellCache from = cacheOf(3), to = cacheOf(3);
  for (const int32_t i : {0, 1, 2}) REQUIRE(from.get(keyOf(i), nothing));
  to.adopt(from, [](const DerivedCell&) { return true; });
  CHECK(to.stats().cells == 3);
  CHECK(has(to, 0));  // the cell would be dropped next; this use prevents that
  REQUIRE(to.get(keyOf(3), nothing));
  CHECK(has(to, 0));
  CHECK_FALSE(has(to, 1));
}

TEST_CASE("where all cells have been asked for one of them goes, and not the one that comes") {
  CellCache from = cacheOf(3), to = cacheOf(3);
  for (const int32_t i : {0, 1, 2}) REQUIRE(from.get(keyOf(i), nothing));
  to.adopt(from, [](const DerivedCell&) { return true; });
  for (const int32_t i : {0, 1, 2}) REQUIRE(has(to, i));
  REQUIRE(to.get(keyOf(3), nothing));
  CHECK(has(to, 3));
  CHECK(to.stats().cells == 3);
}

TEST_CASE("with less room the latest used cells are adopted, in their order") {
  CellCache from = cacheOf(6), to = cacheOf(2);
  for (int32_t i = 0; i < 6; ++i) REQUIRE(from.get(keyOf(i), nothing));
  to.adopt(from, [](const DerivedCell&) { return true; });
  for (int32_t i = 0; i < 6; ++i) CHECK(has(to, i) == (i >= 4));
}

TEST_CASE("threads that find, take and lose cells at one time all get theirs", "[threads]") {
  const uint32_t seed = testSeed();
  CAPTURE(seed);
  CellCache cache = cacheOf(5);
  const auto jobs = *makeThreadPool(8);
  std::atomic<size_t> wrong{0}, asked{0}, seen{0};
  parallelFor(*jobs, 16, [&](size_t thread) {
    std::mt19937 random(seed + static_cast<uint32_t>(thread));
    std::vector<std::shared_ptr<const DerivedCell>> found;
    for (unsigned step = 0; step < rounds(400); ++step) {
      const auto i = static_cast<int32_t>(random() % 9);
      const auto derive = [&]() -> Result<GrammarChunk> {
        GrammarChunk chunk;
        chunk.parameters = static_cast<uint64_t>(i);  // a different value for each chunk
        return chunk;
      };
      const auto cell = cache.get(keyOf(i), derive);
      ++asked;
      wrong += !cell || (*cell)->chunk.parameters != static_cast<uint64_t>(i);
      const CellKey keys[] = {keyOf(i), keyOf(8 - i), keyOf(100)};
      cache.find(keys, found);
      wrong += found.size() != 3 || found[2] != nullptr;
      for (size_t k = 0; k < 2; ++k) {
        const auto whose = static_cast<uint64_t>(k == 0 ? i : 8 - i);
        seen += found[k] != nullptr;
        wrong += found[k] != nullptr && found[k]->chunk.parameters != whose;
      }
    }
  });
  CHECK(wrong == 0);
  const CellCacheStats stats = cache.stats();
  CHECK(stats.hits + stats.misses == asked + seen);
  CHECK(stats.misses == stats.evicted + stats.cells);
  CHECK(stats.cells <= 5);
}
