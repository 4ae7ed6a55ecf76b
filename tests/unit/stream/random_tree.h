#pragma once
// Octrees that are refined at random places.

#include <random>

#include "base/fixed.h"
#include "mesh/chunk.h"
#include "stream/plan/octree.h"

namespace sgm {

/// Returns an octree whose eight root chunks surround the origin, at the level above `top`. It is split `splits` times,
/// at random places that are at most `reach` units from the origin on each axis.
inline Octree randomTree(std::mt19937& random, int top, int32_t finest_cell, int splits, int32_t reach) {
  Octree tree(top, finest_cell);
  for (int corner = 0; corner < 8; ++corner) tree.split({top + 1, {-(corner & 1), -(corner >> 1 & 1), -(corner >> 2)}});
  for (int i = 0; i < splits; ++i) {
    const int level = 1 + static_cast<int>(random() % static_cast<uint32_t>(top));
    const int32_t edge = kChunkCells * finest_cell << level;
    ChunkKey key{level, {}};
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<int32_t>(random() % static_cast<uint32_t>(2 * reach)) - reach;
      key.at[axis] = static_cast<int32_t>(floorDiv(at, edge));
    }
    tree.split(key);
  }
  refineToRules(tree);
  return tree;
}

}  // namespace sgm
