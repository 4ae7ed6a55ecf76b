// Tests wave function collapse: in a solution, the adjacent sides of all tiles fit. A solution is found if one exists,
// and otherwise none is claimed.

#include <algorithm>
#include <bit>
#include <optional>
#include <random>

#include "catch.h"
#include "derive/layout/wave_collapse.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;

namespace {

constexpr uint64_t kEnough = 1'000'000;

struct DrawnWave {
  std::vector<WaveTile> tiles;
  WaveLattice lattice;
  uint64_t key = 0;
};

WaveLabels drawnLabels(std::mt19937& random, unsigned labels) {
  WaveLabels out = WaveLabels{1} << random() % labels;
  if (random() % 4 == 0) out |= WaveLabels{1} << random() % labels;
  return out;
}

DrawnWave drawnWave(std::mt19937& random, unsigned max_tiles, unsigned most_edge) {
  DrawnWave out;
  const unsigned labels = 1 + static_cast<unsigned>(random() % 4);
  out.tiles.resize(1 + random() % max_tiles);
  for (WaveTile& tile : out.tiles) {
    for (WaveLabels& side : tile.sides) side = drawnLabels(random, labels);
    tile.weight = 1 + static_cast<uint32_t>(random() % 1000);
  }
  for (uint32_t& edge : out.lattice.size) edge = 1 + static_cast<uint32_t>(random() % most_edge);
  for (WaveLabels& side : out.lattice.border) side = random() % 2 == 0 ? ~WaveLabels{0} : drawnLabels(random, labels);
  out.key = random();
  return out;
}

/// The place that is adjacent at this side; nullopt at the lattice's border.
std::optional<uint32_t> beyond(const WaveLattice& lattice, uint32_t place, size_t side) {
  constexpr int kSteps[6][3] = {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const auto& n = lattice.size;
  const uint32_t at[3] = {place % n[0], place / n[0] % n[1], place / n[0] / n[1]};
  int64_t to[3];
  for (size_t axis = 0; axis < 3; ++axis) {
    to[axis] = int64_t{at[axis]} + kSteps[side][axis];
    if (to[axis] < 0 || to[axis] >= n[axis]) return std::nullopt;
  }
  return static_cast<uint32_t>(to[0] + n[0] * (to[1] + n[1] * to[2]));
}

constexpr size_t kAcross[6] = {2, 3, 0, 1, 5, 4};

/// Whether a tile is compatible with the tiles at those neighbouring places that are already filled.
bool fitsBeside(const DrawnWave& wave, const std::vector<uint16_t>& tiles, uint32_t place, uint16_t tile) {
  for (size_t side = 0; side < 6; ++side) {
    const std::optional<uint32_t> other = beyond(wave.lattice, place, side);
    if (other && *other >= tiles.size()) continue;
    const WaveLabels met = other ? wave.tiles[tiles[*other]].sides[kAcross[side]] : wave.lattice.border[side];
    if ((wave.tiles[tile].sides[side] & met) == 0) return false;
  }
  return true;
}

/// Whether a solution exists, by trying all tiles, place by place.
bool solvable(const DrawnWave& wave, std::vector<uint16_t>& tiles) {
  const auto& n = wave.lattice.size;
  if (tiles.size() == size_t{n[0]} * n[1] * n[2]) return true;
  const uint32_t place = static_cast<uint32_t>(tiles.size());
  for (uint16_t tile = 0; tile < wave.tiles.size(); ++tile) {
    if (!fitsBeside(wave, tiles, place, tile)) continue;
    tiles.push_back(tile);
    if (solvable(wave, tiles)) return true;
    tiles.pop_back();
  }
  return false;
}

void checkSolution(const DrawnWave& wave, const WaveResult& result) {
  const auto& n = wave.lattice.size;
  REQUIRE(result.tiles.size() == size_t{n[0]} * n[1] * n[2]);
  for (uint32_t place = 0; place < result.tiles.size(); ++place) {
    REQUIRE(result.tiles[place] < wave.tiles.size());
    REQUIRE(fitsBeside(wave, result.tiles, place, result.tiles[place]));
  }
}

/// Tiles with pipes in a plane: one tile for every set of sides through which its pipes leave, except for sets of a
/// single side.
std::vector<WaveTile> pipes() {
  std::vector<WaveTile> out;
  for (unsigned open = 0; open < 16; ++open) {
    if (std::popcount(open) == 1) continue;
    WaveTile tile;
    tile.sides.fill(1);
    for (size_t side = 0; side < 4; ++side)
      if ((open >> side & 1) != 0) tile.sides[side] = 2;
    out.push_back(tile);
  }
  return out;
}

}  // namespace

TEST_CASE("a wave collapses to a solution exactly where trying everything finds one", "[wfc]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  unsigned solved = 0, impossible = 0;
  for (unsigned round = 0; round < rounds(3000); ++round) {
    const DrawnWave wave = drawnWave(random, 5, 3);
    CAPTURE(round, wave.tiles.size(), wave.lattice.size[0], wave.lattice.size[1], wave.lattice.size[2]);
    const WaveResult result = collapseWave(wave.tiles, wave.lattice, wave.key, kEnough);
    std::vector<uint16_t> tiles;
    const bool can = solvable(wave, tiles);
    REQUIRE(result.end == (can ? WaveEnd::solved : WaveEnd::impossible));
    if (can)
      checkSolution(wave, result);
    else
      REQUIRE(result.place < wave.lattice.size[0] * wave.lattice.size[1] * wave.lattice.size[2]);
    ++(can ? solved : impossible);
  }
  CAPTURE(solved, impossible);
  CHECK(solved > rounds(3000) / 10);
  CHECK(impossible > rounds(3000) / 10);
}

TEST_CASE("large lattices of drawn tiles are filled so that every side fits, or it is said why not", "[wfc]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  unsigned solved = 0;
  // Every build tests at least 100 lattices: of only twenty, it may happen that just a quarter is solved.
  const unsigned lattices = std::max(rounds(100), 100u);
  for (unsigned round = 0; round < lattices; ++round) {
    const DrawnWave wave = drawnWave(random, 24, 12);
    CAPTURE(round, wave.tiles.size());
    const WaveResult result = collapseWave(wave.tiles, wave.lattice, wave.key, 200'000);
    REQUIRE(result.visits <= 200'000);
    if (result.end != WaveEnd::solved) continue;
    checkSolution(wave, result);
    ++solved;
  }
  CHECK(solved > lattices / 4);
}

TEST_CASE("a wave collapses to the same tiles every time, and to others by another key", "[wfc]") {
  const std::vector<WaveTile> tiles = pipes();
  WaveLattice lattice;
  lattice.size = {16, 1, 16};
  lattice.border = {1, 1, 1, 1, 1, 1};
  const WaveResult first = collapseWave(tiles, lattice, 7, kEnough), again = collapseWave(tiles, lattice, 7, kEnough);
  REQUIRE(first.end == WaveEnd::solved);
  CHECK(first.tiles == again.tiles);
  CHECK(first.visits == again.visits);
  CHECK(collapseWave(tiles, lattice, 8, kEnough).tiles != first.tiles);
}

TEST_CASE("tiles are drawn in proportion to their weights where everything fits", "[wfc]") {
  std::vector<WaveTile> tiles(3);
  for (WaveTile& tile : tiles) tile.sides.fill(1);
  tiles[0].weight = 1000;
  tiles[1].weight = 3000;
  tiles[2].weight = 6000;
  WaveLattice lattice;
  lattice.size = {30, 10, 30};
  lattice.border.fill(1);
  const WaveResult result = collapseWave(tiles, lattice, 3, kEnough);
  REQUIRE(result.end == WaveEnd::solved);
  for (size_t t = 0; t < 3; ++t) {
    const double share = static_cast<double>(std::count(result.tiles.begin(), result.tiles.end(), t)) / 9000;
    CHECK(share == Approx(tiles[t].weight / 10000.0).margin(0.02));
  }
}

TEST_CASE("what nothing fits is said with what it would have to meet", "[wfc]") {
  // Tiles 1 and 2 must alternate along x, so an odd number of places cannot begin with 1 and end with 2.
  std::vector<WaveTile> tiles(2);
  for (WaveTile& tile : tiles) tile.sides.fill(8);
  tiles[0].sides[3] = 1;
  tiles[0].sides[1] = 2;
  tiles[1].sides[3] = 2;
  tiles[1].sides[1] = 1;
  WaveLattice lattice;
  lattice.size = {4, 1, 1};
  lattice.border = {8, 1, 8, 1, 8, 8};
  CHECK(collapseWave(tiles, lattice, 1, kEnough).tiles == std::vector<uint16_t>{0, 1, 0, 1});
  lattice.size = {5, 1, 1};
  const WaveResult odd = collapseWave(tiles, lattice, 1, kEnough);
  CHECK(odd.end == WaveEnd::impossible);
  CHECK((odd.wanted[1] & odd.wanted[3]) != 0);
  CHECK(odd.wanted[4] == 8);
  // No tile has this border label.
  lattice.border[4] = 4;
  const WaveResult top = collapseWave(tiles, lattice, 1, kEnough);
  CHECK(top.end == WaveEnd::impossible);
  CHECK(top.place == 0);
  CHECK(top.wanted[4] == 4);
}

TEST_CASE("a search that is too long is given up and counted", "[wfc]") {
  // The limit of 200 visits allows the first visit of each of the 144 places, but not the search that follows.
  const std::vector<WaveTile> tiles = pipes();
  WaveLattice lattice;
  lattice.size = {12, 1, 12};
  lattice.border = {1, 1, 1, 1, 1, 1};
  const WaveResult result = collapseWave(tiles, lattice, 1, 200);
  CHECK(result.end == WaveEnd::gave_up);
  CHECK(result.tiles.empty());
  CHECK(result.visits == 200);
  // The limit of 143 visits does not even allow one visit of each of the 144 places.
  const WaveResult none = collapseWave(tiles, lattice, 1, 143);
  CHECK(none.end == WaveEnd::gave_up);
  CHECK(none.place == kNoPlace);
  CHECK(none.visits == 0);
}

TEST_CASE("a search is given up within one choice, however far that reaches", "[wfc]") {
  // Each tile requires the next tile on its left, and the last tile fits only to itself. So the choice of one tile
  // removes all other tiles at all places, one after the other.
  std::vector<WaveTile> tiles(60);
  for (size_t t = 0; t < tiles.size(); ++t) {
    tiles[t].sides.fill(1);
    tiles[t].sides[1] = WaveLabels{2} << t;
    tiles[t].sides[3] = WaveLabels{2} << std::min(t + 1, tiles.size() - 1);
  }
  WaveLattice lattice;
  lattice.size = {4000, 1, 1};
  lattice.border.fill(~WaveLabels{0});
  const WaveResult result = collapseWave(tiles, lattice, 1, 8000);
  CHECK(result.end == WaveEnd::gave_up);
  CHECK(result.visits == 8000);
  CHECK(result.place == kNoPlace);
}

TEST_CASE("visits count for more among many labels and tiles, and memory has an end", "[wfc]") {
  for (const size_t labels : {2u, 8u, 16u, 64u}) {
    for (const size_t count : {64u, 256u}) {
      std::vector<WaveTile> tiles(count);
      for (size_t t = 0; t < count; ++t) tiles[t].sides.fill(WaveLabels{1} << t % labels);
      WaveLattice lattice;
      lattice.size = {5, 3, 4};
      lattice.border.fill(~WaveLabels{0});
      const WaveResult result = collapseWave(tiles, lattice, 7, 100'000);
      CAPTURE(labels, count);
      CHECK(result.end == WaveEnd::solved);
      CHECK(result.work == result.visits * std::max<size_t>(1, labels * (count / 64) / 8));
      const WaveResult poor = collapseWave(tiles, lattice, 7, 100'000, 64);
      CHECK(poor.end == WaveEnd::gave_up);
      CHECK(poor.visits < result.visits);
    }
  }
}
