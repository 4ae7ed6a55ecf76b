#pragma once
// Cellular automata over the world's voxels: random fill, then rounds of neighbour counting (Johnson, Yannakakis,
// Togelius 2010, extended to three dimensions).

#include <array>
#include <cstdint>
#include <vector>

#include "base/fixed.h"

namespace sgm {

/// Every voxel of the world, one per integer triple. Along an axis that is not in `axes`, all voxels are equal.
struct Automaton {
  uint64_t seed = 0;
  std::array<bool, 3> axes{true, true, true};
  double fill = 0.45;  ///< the probability that a voxel starts solid, to 1/65536
  int32_t rounds = 4;
  int32_t least = 14;  ///< solid voxels in the cube, itself included, that make a voxel solid in the next round
  int32_t radius = 1;  ///< of the cube (square) that is counted, 1 to 15

  /// The maximum distance, in voxels, at which a voxel influences another.
  int32_t halo() const { return rounds * radius; }
};

/// Voxels first .. first + count - 1 along each axis.
struct VoxelBox {
  Int3 first, count;
};

/// The state after all rounds: 1 solid, 0 not, x fastest; exactly as if the automaton had run over the whole world,
/// since it starts from the box grown by the halo. `count` is 1 along an axis that is not one of the automaton's; the
/// indices of the grown box must fit int32. Memory: six bytes per voxel of the grown box.
std::vector<uint8_t> runAutomaton(const Automaton& automaton, const VoxelBox& box);

}  // namespace sgm
