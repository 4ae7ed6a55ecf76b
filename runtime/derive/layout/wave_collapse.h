#pragma once
// Wave function collapse: chooses one of the given tiles for every place of a lattice, so that touching sides share a
// label. The simple tiled model of M. Gumin (WaveFunctionCollapse, 2016) as a search with propagated constraints, after
// I. Karth and A. M. Smith, WaveFunctionCollapse is Constraint Solving in the Wild, FDG 2017.
//
// Only integers and hashes, so the tiles are the same on every machine.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sgm {

/// Sides of a place in the order of BoxPart: front (+z), right (+x), back (-z), left (-x), top (+y), bottom (-y).
inline constexpr size_t kWaveSides = 6;
/// Labels of a side, one bit each. Two sides match if they have a label in common.
using WaveLabels = uint64_t;

/// A tile in one orientation: a rotatable tile is four of these.
struct WaveTile {
  std::array<WaveLabels, kWaveSides> sides{};
  uint32_t weight = 1;  ///< 1 to 2^24: relative probability among the tiles that fit
};

inline constexpr uint32_t kNoPlace = 0xFFFFFFFFu;

struct WaveLattice {
  std::array<uint32_t, 3> size{1, 1, 1};        ///< places along x, y, z; their product is below 2^24
  std::array<WaveLabels, kWaveSides> border{};  ///< the labels outside each side of the lattice
};

enum class WaveEnd : uint8_t {
  solved,
  impossible,  ///< proven: no choice of tiles fits
  gave_up,     ///< after most_visits, at once if these are fewer than the places, or for lack of memory
};

struct WaveResult {
  WaveEnd end = WaveEnd::solved;
  std::vector<uint16_t> tiles;  ///< solved: for each place, x first, then y, then z
  uint64_t visits = 0;          ///< visited places, the measure of the work; at most most_visits
  uint64_t work = 0;            ///< the cost of these: a visit costs more with many labels and tiles
  /// If not solved: the place where no tile fitted, most often if there were several, and the labels of which each of
  /// its sides would have had to match any. kNoPlace: the search ended before there was such a place.
  uint32_t place = 0;
  std::array<WaveLabels, kWaveSides> wanted{};
};

/// tiles: 1 to 256. Finds a solution if one exists and the visits allow it. Unless it is proven impossible, the search
/// restarts several times, each time twice as long, and begins with the places that were difficult. key: of the draws;
/// equal input gives equal output. most_bytes: memory for undoing choices.
WaveResult collapseWave(std::span<const WaveTile> tiles, const WaveLattice& lattice, uint64_t key, uint64_t most_visits,
                        size_t most_bytes = SIZE_MAX);

}  // namespace sgm
