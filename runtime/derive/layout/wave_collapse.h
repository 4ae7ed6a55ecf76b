#pragma once
// Wave function collapse: one of the given tiles for every place of a lattice, so that sides which touch share a label.
// The simple tiled model of M. Gumin (WaveFunctionCollapse, 2016) as a search with propagated constraints, after
// I. Karth and A. M. Smith, WaveFunctionCollapse is Constraint Solving in the Wild, FDG 2017.
//
// Integers and hashes alone: the same tiles on every machine.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sgm {

/// Sides of a place in the order of BoxPart: front (+z), right (+x), back (-z), left (-x), top (+y), bottom (-y).
inline constexpr size_t kWaveSides = 6;
/// Labels of a side, one a bit. A side meets what it has a label in common with.
using WaveLabels = uint64_t;

/// A tile as it stands: one that may be turned is four of these.
struct WaveTile {
  std::array<WaveLabels, kWaveSides> sides{};
  uint32_t weight = 1;  ///< 1 to 2^24: how often it is drawn among those that fit
};

inline constexpr uint32_t kNoPlace = 0xFFFFFFFFu;

struct WaveLattice {
  std::array<uint32_t, 3> size{1, 1, 1};        ///< places along x, y, z; their product is below 2^24
  std::array<WaveLabels, kWaveSides> border{};  ///< what stands outside of each side of the lattice
};

enum class WaveEnd : uint8_t {
  solved,
  impossible,  ///< proven: no choice of tiles fits
  gave_up,     ///< after most_visits, at once where these are fewer than the places, or for want of memory
};

struct WaveResult {
  WaveEnd end = WaveEnd::solved;
  std::vector<uint16_t> tiles;  ///< solved: for each place, x first, then y, then z
  uint64_t visits = 0;  ///< places whose neighbours were looked at: the measure of the work; most_visits at most
  uint64_t work = 0;    ///< what these cost: a visit counts for more where there are many labels and tiles
  /// Not solved: where no tile fitted, most often if there were several such places, and what each side of it would
  /// have had to meet, any of it. kNoPlace: given up before there was one.
  uint32_t place = 0;
  std::array<WaveLabels, kWaveSides> wanted{};
};

/// tiles: 1 to 256. Finds a choice wherever there is one and the visits allow it; one that is not proven impossible is
/// searched for several times, for twice as long each, and places that were hard go first. key: draws; equal input
/// gives equal output. most_bytes: of what the search notes to take its choices back.
WaveResult collapseWave(std::span<const WaveTile> tiles, const WaveLattice& lattice, uint64_t key, uint64_t most_visits,
                        size_t most_bytes = SIZE_MAX);

}  // namespace sgm
