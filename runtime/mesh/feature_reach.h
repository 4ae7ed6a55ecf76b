#pragma once
// The reach of sharp features.

#include <cstdint>

#include "mesh/chunk.h"

namespace sgm {

/// The maximum distance of a feature vertex from its cell, or beyond its face, in 1/256 of a cell. A right-angled ridge
/// that no sample detects is up to sqrt(1/2) of a cell high. It is less than a cell, so that a fan never reaches a cell
/// two cells away.
inline constexpr int32_t kMostOutside = 200;

/// How far from a chunk the field of a level with such cells is sampled for sharp features, in units. A face vertex in
/// the coarser chunk's face depends on loops up to two squares away from its side's square, also beyond the finer
/// chunk, and these depend on face vertices up to kMostOutside beyond theirs (mesh/surroundings.h,
/// mesh/rounded_cells.h).
inline constexpr int64_t sharpReach(int64_t cell) { return 3 * cell + 1; }

}  // namespace sgm
