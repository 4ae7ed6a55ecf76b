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

/// Finds the visible shapes that are thinner than a cell, at the level whose cells have this edge (units). In an
/// intersection, a sum or a morph, only the operand that determines the thickness is considered (see thinParts).
std::vector<ThinShape> findThinShapes(const GrammarChunk& chunk, int32_t cell_edge);

}  // namespace sgm
