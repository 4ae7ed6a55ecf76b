#pragma once
// Cellular automata over the world's voxels: random fill, then rounds of neighbour counting (Johnson, Yannakakis,
// Togelius 2010, extended to three dimensions).

#include <array>
#include <cstdint>
#include <vector>

#include "base/fixed.h"

namespace sgm {

/// An automaton over all voxels of the world, one voxel for each integer triple. Along an axis that is not in `axes`,
/// all voxels are equal.
struct Automaton {
  uint64_t seed = 0;
  std::array<bool, 3> axes{true, true, true};
  double fill = 0.45;  ///< probability that a voxel starts solid; rounded to 1/65536
  int32_t rounds = 4;
  /// a voxel becomes solid if the cube around it contains at least this many solid voxels, itself included
  int32_t least = 14;
  int32_t radius = 1;  ///< the cube (or square) around a voxel has 2 * radius + 1 voxels per edge; radius: 1 to 15

  /// Returns the maximum distance, in voxels, at which a voxel influences another.
  int32_t halo() const { return rounds * radius; }
};

/// The voxels with indices first .. first + count - 1 along each axis.
struct VoxelBox {
  Int3 first, count;
};

/// Returns the state after all rounds: 1 solid, 0 void; x fastest. The result is the same as if the automaton had run
/// over the whole world, since it starts from the box enlarged by the halo. box.count must be 1 along axes that are not
/// in `axes`; indices in the enlarged box must fit int32. Memory: six bytes per voxel of the enlarged box.
std::vector<uint8_t> runAutomaton(const Automaton& automaton, const VoxelBox& box);

}  // namespace sgm
