// Tests distances to the nearest solid sample, by comparison with examining all samples.

#include "mesh/clearance.h"

#include <random>

#include "catch.h"
#include "rounds.h"

using namespace sgm;

namespace {

constexpr int kWide = 3 * kChunkCells + 1;  // number of samples along three chunks in a row

/// Samples of 27 chunks, divided into chunks.
struct Block {
  std::vector<bool> solid = std::vector<bool>(size_t{kWide} * kWide * kWide);
  std::vector<ChunkSigns> chunks = std::vector<ChunkSigns>(27);

  size_t index(int x, int y, int z) const { return static_cast<size_t>(x + kWide * (y + kWide * z)); }

  ChunkSignsAround cut() {
    ChunkSignsAround around;
    for (int c = 0; c < 27; ++c) {
      ChunkSigns& chunk = chunks[static_cast<size_t>(c)];
      chunk.rows.clear();
      uint64_t any = 0, all = ~uint64_t{0};
      for (int z = 0; z < kChunkSamples; ++z) {
        for (int y = 0; y < kChunkSamples; ++y) {
          uint64_t row = 0;
          for (int x = 0; x < kChunkSamples; ++x)
            row |= uint64_t{solid[index(c % 3 * 32 + x, c / 3 % 3 * 32 + y, c / 9 * 32 + z)]} << x;
          chunk.rows.push_back(row);
          any |= row;
          all &= row | ~((uint64_t{1} << kChunkSamples) - 1);
        }
      }
      chunk.solid = any != 0;
      if (any == 0 || all == ~uint64_t{0}) chunk.rows.clear();
      around[static_cast<size_t>(c)] = &chunk;
    }
    return around;
  }
};

}  // namespace

TEST_CASE("clearances are the distances to the nearest solid sample") {
  size_t far = 0;
  for (uint32_t seed = 1; seed <= rounds(20); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Block block;
    std::vector<std::array<int, 3>> solids;
    const auto count = seed % 5 == 0 ? uint64_t{0} : 1 + random() % (seed % 2 == 0 ? 6 : 300);
    for (uint64_t i = 0; i < count; ++i) {
      const auto at = [&] { return static_cast<int>(random() % kWide); };
      solids.push_back({at(), at(), at()});
      block.solid[block.index(solids.back()[0], solids.back()[1], solids.back()[2])] = true;
    }
    const ChunkSignsAround around = block.cut();
    const int most = std::array{2, 3, 9, 10, 200, 1024}[random() % 6];
    CAPTURE(most, count);
    const std::pmr::vector<uint16_t> found = squaredClearance(around, most);
    const std::pmr::vector<uint64_t> rows = rowsBelow(found, most / 2);
    size_t wrong = 0, wrong_bits = 0;
    for (int i = 0; i < kChunkSamples * kChunkSamples * kChunkSamples; ++i) {
      const std::array<int, 3> p{i % 33 + 32, i / 33 % 33 + 32, i / 33 / 33 + 32};
      int expected = most;
      for (const std::array<int, 3>& s : solids)
        expected = std::min(
            expected, (s[0] - p[0]) * (s[0] - p[0]) + (s[1] - p[1]) * (s[1] - p[1]) + (s[2] - p[2]) * (s[2] - p[2]));
      wrong += found[static_cast<size_t>(i)] != expected;
      wrong_bits += (rows[static_cast<size_t>(i / 33)] >> (i % 33) & 1) != (expected < most / 2);
      far += expected > 100 && expected < most;
    }
    CHECK(wrong == 0);
    CHECK(wrong_bits == 0);
  }
  CHECK(far > 0);
}

TEST_CASE("with one cell's clearance the chunk's own signs are all that counts") {
  ChunkSigns own, rock;
  rock.solid = true;
  std::mt19937 random(1);
  for (int row = 0; row < kChunkSamples * kChunkSamples; ++row)
    own.rows.push_back((uint64_t{random()} << 32 | random()) & ((uint64_t{1} << kChunkSamples) - 1));
  ChunkSignsAround around;
  around.fill(&rock);
  around[13] = &own;
  CHECK(rowsBelow(squaredClearance(around, 1), 1) == own.rows);
  around[13] = &rock;
  CHECK(squaredClearance(around, 9) == std::pmr::vector<uint16_t>(33 * 33 * 33, 0));
}
