#pragma once
// Distances at which vertices move towards the surface of the next coarser level (geomorphing), so that level changes
// do not pop.

#include <array>

#include "picture.h"

namespace sgm_godot {

/// For each level: vertices start to move at `begin` metres from the nearest viewer, and have reached the coarser
/// surface at `end` metres. If begin >= end, no vertex of the level moves.
struct MorphRanges {
  std::array<float, SGM_MAX_LEVEL + 1> begin{}, end{};
  friend bool operator==(const MorphRanges&, const MorphRanges&) = default;
};

/// Computes the ranges from the drawn chunks. A seam belongs to the finer of two neighbouring chunks, and joins it to
/// vertices of the coarser level; the coarser vertices do not move in the seam. To avoid gaps there, a level's vertices
/// begin to move only farther away than all drawn chunks of the next finer level that have seams. (A range computed
/// from the world's level distances alone would open gaps: chunks are large and extend beyond the distance of their
/// level.) The range of a level ends at the farthest point of its nearest drawn chunk with a seam. `viewers`: in units
/// of the world. `cell_units`: cell size of level 0.
MorphRanges morphRanges(const std::vector<Picture::Shown>& shown, const std::vector<Units>& viewers, int32_t cell_units,
                        int32_t top_level);

}  // namespace sgm_godot
