#pragma once
// Cellular automata over the world's voxels: random fill, then rounds of counting (Johnson, Yannakakis, Togelius 2010,
// and the same in three dimensions).

#include <array>
#include <cstdint>
#include <vector>

#include "base/fixed.h"

namespace sgm {

/// Every voxel of the world, one for each triple of integers. Along an axis that is not one of `axes` all voxels are
/// alike.
struct Automaton {
  uint64_t seed = 0;
  std::array<bool, 3> axes{true, true, true};
  double fill = 0.45;  ///< the chance of a voxel to start solid, to 1/65536
  int32_t rounds = 4;
  int32_t least = 14;  ///< solid voxels around one, itself among them, that make it solid in the next round
  int32_t radius = 1;  ///< of the cube (square) of voxels that counts, 1 to 15

  /// How many voxels away one may lie that decides about another.
  int32_t halo() const { return rounds * radius; }
};

/// Voxels first .. first + count - 1 along each axis.
struct VoxelBox {
  Int3 first, count;
};

/// After all rounds: 1 solid, 0 not, x fastest; exactly as if the automaton had run over the whole world, for it starts
/// from the box grown by the halo. `count` is 1 along an axis that is not one of the automaton's; the indices of the
/// grown box fit int32. Memory: six bytes for each voxel of the grown box.
std::vector<uint8_t> runAutomaton(const Automaton& automaton, const VoxelBox& box);

}  // namespace sgm
