#pragma once
// Computes the distance of each sample of a chunk from the nearest solid sample: a ball fits there if the distance
// exceeds its radius.
//
// Distances are exact, between samples, in cells. The meshed solid contains all solid samples and reaches beyond them
// by less than the diagonal of a cell (1.74 cells; usually less than one cell, along an axis). The field's values
// cannot be used instead: they are distances only near a surface (field/program.h).

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "mesh/chunk.h"

namespace sgm {

/// Larger distances are clamped to this value, in cells: a chunk and its 26 neighbours cannot determine larger ones.
inline constexpr int kMaxClearance = kChunkCells;

/// The signs of a chunk's samples.
struct ChunkSigns {
  std::pmr::vector<uint64_t> rows;  ///< same as ChunkSamples::signs; empty if all samples have the same sign
  bool solid = false;               ///< the sign of all samples if rows is empty

  /// Bit x is set if sample x of the row is solid.
  uint64_t row(int y, int z) const {
    if (rows.empty()) return solid ? (uint64_t{1} << kChunkSamples) - 1 : 0;
    return rows[static_cast<size_t>(y + z * kChunkSamples)];
  }
};

/// The signs of a chunk and of the 26 chunks around it. The chunk at offset (dx, dy, dz) has index (dx + 1) + 3 (dy +
/// 1) + 9 (dz + 1).
using ChunkSignsAround = std::array<const ChunkSigns*, 27>;

/// Returns the squared distances, in square cells, from each sample of the middle chunk to the nearest solid sample; x
/// fastest, then y, then z. Distances above `most` (1 to kMaxClearance squared) are returned as `most`. Reads only the
/// samples within sqrt(most) of the middle chunk; if most = 1, the middle chunk alone. Pure.
std::pmr::vector<uint16_t> squaredClearance(const ChunkSignsAround& around, int most,
                                            std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Returns rows in the format of ChunkSamples::signs: bit x is set if the squared clearance of sample x is below
/// `need`.
std::pmr::vector<uint64_t> rowsBelow(const std::pmr::vector<uint16_t>& clearance, int need);

}  // namespace sgm
