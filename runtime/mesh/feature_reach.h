#pragma once
// How far sharp features reach.

#include <cstdint>

#include "mesh/chunk.h"

namespace sgm {

/// How far a feature vertex may lie outside of its cell, or beyond its face, in 1/256 of a cell. A ridge with a right
/// angle that no sample sees is up to sqrt(1/2) of a cell high. Below a whole cell, so that a fan never reaches a cell
/// two cells away.
inline constexpr int32_t kMostOutside = 200;

/// How far from a chunk the field of a level with such cells is sampled for sharp features, in units. A face vertex in
/// the coarser chunk's face depends on loops up to two squares away from its side's own, beyond the finer chunk, too,
/// and these on face vertices up to kMostOutside beyond theirs (mesh/surroundings.h, mesh/rounded_cells.h).
inline constexpr int64_t sharpReach(int64_t cell) { return 3 * cell + 1; }

}  // namespace sgm
