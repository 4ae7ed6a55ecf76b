// Tests the cell sizes that are suggested for a region with too many chunks: they suffice, and smaller round ones do
// not.

#include "world/fitting_cell.h"
#include "seed.h"

#include <cmath>
#include <random>

#include "catch.h"
#include "mesh/chunk.h"
#include "rounds.h"

using namespace sgm;

namespace {

uint64_t chunksOf(std::span<const IntBox> regions, double metres, int level) {
  uint64_t all = 0;
  for (const IntBox& region : regions)
    all += countChunks(region, static_cast<int64_t>(std::floor(metres * kUnitsPerMetre + 0.5)) << level);
  return all;
}

}  // namespace

TEST_CASE("the cells that are advised fit, and much smaller ones seldom do") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t advised = 0, tight = 0;
  for (unsigned round = 0; round < rounds(500); ++round) {
    std::vector<IntBox> regions(1 + random() % 3);
    for (IntBox& region : regions) {
      for (int axis = 0; axis < 3; ++axis) {
        region.lo[axis] = static_cast<int32_t>(random() % 2'000'000) - 1'000'000;
        region.hi[axis] = region.lo[axis] + 1 + static_cast<int32_t>(random() % (1u << random() % 24));
      }
    }
    const int level = static_cast<int>(random() % 4);
    const auto cell = static_cast<int32_t>(1 + random() % 2048);
    // A box across a corner of the grid overlaps eight chunks at any cell size, so a smaller limit could never be kept.
    const uint64_t most = 8 * regions.size() + random() % 5000;
    const std::optional<double> edge = fittingCell(regions, level, cell, most);
    if (!edge) continue;
    CAPTURE(round, level, cell, most, *edge);
    ++advised;
    CHECK(chunksOf(regions, *edge, level) <= most);
    CHECK(std::floor(*edge * kUnitsPerMetre + 0.5) >= cell);
    // The suggested cell size has two significant digits at most.
    double digits = *edge;
    while (digits < 10) digits *= 10;
    while (digits >= 100) digits /= 10;
    CHECK(std::fabs(digits - std::floor(digits + 0.5)) < 1e-9);
    const double smaller = *edge / 1.6;
    tight += smaller * kUnitsPerMetre < cell || chunksOf(regions, smaller, level) > most;
  }
  CHECK(advised > rounds(500) / 2);
  CHECK(tight * 10 > advised * 9);
  const IntBox wide{{0, 0, 0}, {1 << 30, 1 << 30, 1 << 30}};
  CHECK_FALSE(fittingCell({&wide, 1}, 0, 1, 1));
  CHECK(fittingCellText({&wide, 1}, 0, 1, 1).empty());
  const IntBox room{{0, 0, 0}, {10 * kUnitsPerMetre, 10 * kUnitsPerMetre, 10 * kUnitsPerMetre}};
  CHECK(fittingCellText({&room, 1}, 0, 1, 8) == " (cells of 0.2 m fit)");
  CHECK(fittingCellText({&room, 1}, 0, 1024, 8) == " (cells of 1 m fit)");
}
