#pragma once
// How far the samples of a chunk lie from the nearest solid one: a ball fits where that is farther than its radius.
//
// Distances are between samples, in cells, and exact. The solid itself, as the mesh has it, reaches beyond its samples
// by less than the diagonal of a cell (1.74 cells; as a rule less than one, along an axis), and never stays behind
// them. Values of the field would not do: they are distances only near a surface (field/program.h).

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "mesh/chunk.h"

namespace sgm {

/// Distances from there on are one: in cells, the farthest that chunks side by side can tell.
inline constexpr int kMostClearance = kChunkCells;

/// The signs of a chunk's samples.
struct ChunkSigns {
  std::pmr::vector<uint64_t> rows;  ///< as ChunkSamples::signs; empty where all are one
  bool solid = false;               ///< where they are one

  /// Bit x is set where sample x of the row is solid.
  uint64_t row(int y, int z) const {
    if (rows.empty()) return solid ? (uint64_t{1} << kChunkSamples) - 1 : 0;
    return rows[static_cast<size_t>(y + z * kChunkSamples)];
  }
};

/// A chunk, and the 26 around it: number (dx + 1) + 3 (dy + 1) + 9 (dz + 1).
using ChunkSignsAround = std::array<const ChunkSigns*, 27>;

/// Squares of the distances, in cells, from each sample of the middle chunk to the nearest solid sample: x fastest,
/// then y, then z; at most `most`, 1 to kMostClearance squared. Around it only solids within sqrt(most) are looked at;
/// with most = 1 the middle chunk alone. Pure.
std::pmr::vector<uint16_t> squaredClearance(const ChunkSignsAround& around, int most,
                                            std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Rows as ChunkSamples::signs, of what is not free for those that need a clearance of sqrt(need) cells: bit x is set
/// where sample x has less.
std::pmr::vector<uint64_t> rowsBelow(const std::pmr::vector<uint16_t>& clearance, int need);

}  // namespace sgm
