#pragma once
// Where vertices move towards the next coarser level, so that no change of level pops.

#include <array>

#include "picture.h"

namespace sgm_godot {

/// By level: from `begin` metres from the nearest viewer on vertices start to move, at `end` they have arrived; begin
/// >= end: none moves.
struct MorphRanges {
  std::array<float, SGM_MAX_LEVEL + 1> begin{}, end{};
  friend bool operator==(const MorphRanges&, const MorphRanges&) = default;
};

/// Seams join vertices of a level that do not move, where it meets a finer one: so that nothing opens, a level moves
/// only beyond all chunks of finer levels that are drawn with a seam, as they stand at this moment. (A range from the
/// world's distances alone would open gaps: chunks are large, and reach beyond their level's distance.) What moves
/// arrives at the nearest place where the level ends. `viewers`: in units of the world; `cell_units` of level 0.
MorphRanges morphRanges(const std::vector<Picture::Shown>& shown, const std::vector<Units>& viewers, int32_t cell_units,
                        int32_t top_level);

}  // namespace sgm_godot
