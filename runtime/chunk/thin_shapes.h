#pragma once
// Finds the shapes of a derived cell that are thinner than a cell of the meshed level.

#include <vector>

#include "chunk/slab.h"

namespace sgm {

struct ThinShape {
  uint32_t shape = 0;  ///< index of the shape in GrammarChunk::shapes
  Slab slab;
  bool cut = false;  ///< true: the shape is cut away; false: it is added
};

/// Finds the shapes that are visible at a level whose cells have this edge, in units, and that are thinner than such a
/// cell. In an intersection, a sum or a morph, only the operand that determines the thickness is considered
/// (thinParts).
std::vector<ThinShape> findThinShapes(const GrammarChunk& chunk, int32_t cell_edge);

}  // namespace sgm
