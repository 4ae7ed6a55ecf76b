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

/// Computes the ranges from the drawn chunks. A seam belongs to the finer of two chunks, and joins it to vertices of
/// the coarser level, which do not move in the seam. So that no gap opens, a level moves only beyond all drawn chunks
/// of the next finer level that have seams. (A range computed from the world's distances alone would open gaps, because
/// chunks are large and extend beyond their level's distance.) The end of a level's range is the distance at which the
/// first of its drawn chunks with a seam ends. `viewers`: in units of the world. `cell_units`: cell size of level 0.
MorphRanges morphRanges(const std::vector<Picture::Shown>& shown, const std::vector<Units>& viewers, int32_t cell_units,
                        int32_t top_level);

}  // namespace sgm_godot
