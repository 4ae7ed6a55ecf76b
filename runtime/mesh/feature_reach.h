#pragma once
// Limits on how far sharp features reach beyond their cells, and on how much of the field they depend on.

#include <cstdint>

#include "mesh/chunk.h"

namespace sgm {

/// The maximum distance of a feature vertex from its cell, or of a face vertex from its face's square, in 1/256 of a
/// cell. A right-angled ridge can rise up to sqrt(1/2) of a cell (181/256) between samples that do not detect it. The
/// limit is less than a cell, so that a fan never reaches a cell two cells away.
inline constexpr int32_t kMaxOutside = 200;

/// Returns how far beyond a chunk the field is sampled for sharp features, in units. cell: the chunk's cell edge in
/// units. A face vertex in the coarser chunk's face depends on loops up to two squares away, also beyond the finer
/// chunk. These loops in turn depend on face vertices up to kMaxOutside beyond their own squares (mesh/surroundings.h,
/// mesh/rounded_cells.h).
inline constexpr int64_t sharpReach(int64_t cell) { return 3 * cell + 1; }

}  // namespace sgm
