#pragma once
// The distance of a chunk's samples from the nearest solid one: a ball fits if the distance exceeds its radius.
//
// Distances are between samples, in cells, and exact. The meshed solid reaches beyond its samples by less than the
// diagonal of a cell (1.74 cells; usually less than one, along an axis), and always contains them. Field values are not
// suitable: they are distances only near a surface (field/program.h).

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "mesh/chunk.h"

namespace sgm {

/// Larger distances are clamped to this, in cells: adjacent chunks cannot determine more.
inline constexpr int kMostClearance = kChunkCells;

/// The signs of a chunk's samples.
struct ChunkSigns {
  std::pmr::vector<uint64_t> rows;  ///< same as ChunkSamples::signs; empty if all are equal
  bool solid = false;               ///< the sign if all are equal

  /// Bit x is set if sample x of the row is solid.
  uint64_t row(int y, int z) const {
    if (rows.empty()) return solid ? (uint64_t{1} << kChunkSamples) - 1 : 0;
    return rows[static_cast<size_t>(y + z * kChunkSamples)];
  }
};

/// A chunk and the 26 around it: index (dx + 1) + 3 (dy + 1) + 9 (dz + 1).
using ChunkSignsAround = std::array<const ChunkSigns*, 27>;

/// Squared distances, in cells, from each sample of the middle chunk to the nearest solid sample: x fastest, then y,
/// then z; at most `most`, 1 to kMostClearance squared. Considers only solids within sqrt(most); if most = 1, the
/// middle chunk alone. Pure.
std::pmr::vector<uint16_t> squaredClearance(const ChunkSignsAround& around, int most,
                                            std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Rows in the format of ChunkSamples::signs: bit x is set if sample x has less clearance than sqrt(need) cells.
std::pmr::vector<uint64_t> rowsBelow(const std::pmr::vector<uint16_t>& clearance, int need);

}  // namespace sgm
