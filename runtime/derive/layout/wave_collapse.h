#pragma once
// Wave function collapse: chooses one of the given tiles for every place of a lattice, so that touching sides have a
// label in common. This is the simple tiled model of M. Gumin (WaveFunctionCollapse, 2016) as a search with constraint
// propagation, after I. Karth and A. M. Smith, WaveFunctionCollapse is Constraint Solving in the Wild, FDG 2017. Uses
// only integers and hashes, so the result is the same on every machine.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sgm {

/// Sides of a place in the order of BoxPart: front (+z), right (+x), back (-z), left (-x), top (+y), bottom (-y).
inline constexpr size_t kWaveSides = 6;
/// Labels of a side, one bit each. Two sides match if they have a label in common.
using WaveLabels = uint64_t;

/// A tile in one orientation; a tile that may be rotated is passed as four WaveTiles.
struct WaveTile {
  std::array<WaveLabels, kWaveSides> sides{};
  uint32_t weight = 1;  ///< 1 to 2^24: relative probability among the tiles that fit
};

inline constexpr uint32_t kNoPlace = 0xFFFFFFFFu;

struct WaveLattice {
  std::array<uint32_t, 3> size{1, 1, 1};  ///< number of places along x, y, z; the product is below 2^24
  /// labels that the places at each border of the lattice must match
  std::array<WaveLabels, kWaveSides> border{};
};

enum class WaveEnd : uint8_t {
  solved,
  impossible,  ///< it is proven that no choice of tiles fits
  gave_up,     ///< the search needs more than max_visits visits (it ends at once if max_visits is less than the number
               ///< of places) or more than max_bytes
};

struct WaveResult {
  WaveEnd end = WaveEnd::solved;
  std::vector<uint16_t> tiles;  ///< index of the tile at each place, if solved; x fastest, then y, then z
  uint64_t visits = 0;          ///< number of visits of places, as a measure of the work; at most max_visits
  uint64_t work = 0;            ///< cost of the visits: a visit costs more with many labels and tiles
  /// If not solved: the place where the search most often found no tile that fits. wanted: for each side of this place,
  /// the labels that the neighbour there allows. kNoPlace: the search ended before any place failed.
  uint32_t place = 0;
  std::array<WaveLabels, kWaveSides> wanted{};
};

/// Finds a solution if one exists and the limits allow it. Unless the problem is proven impossible, the search restarts
/// several times. Each search may undo twice as many choices as the previous one, and starts with the places that
/// failed most often before. tiles: 1 to 256. key: seed of the draws; equal inputs give equal results. max_bytes: limit
/// of the memory for undoing choices.
WaveResult collapseWave(std::span<const WaveTile> tiles, const WaveLattice& lattice, uint64_t key, uint64_t max_visits,
                        size_t max_bytes = SIZE_MAX);

}  // namespace sgm
