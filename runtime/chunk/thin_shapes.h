#pragma once
// Finds the shapes of a derived cell that are thinner than a cell of the meshed level.

#include <vector>

#include "chunk/slab.h"

namespace sgm {

struct ThinShape {
  uint32_t shape = 0;  ///< index in GrammarChunk::shapes
  Slab slab;
  bool cut = false;  ///< true: the shape is cut away
};

/// Finds the shapes that are visible at a level whose cells have this edge, in units, and thinner than such a cell. Of
/// an intersection, a sum or a morph, only the operand counts that sets its thickness (thinParts).
std::vector<ThinShape> findThinShapes(const GrammarChunk& chunk, int32_t cell_edge);

}  // namespace sgm
