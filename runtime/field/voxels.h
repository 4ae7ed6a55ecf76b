#pragma once
// Compiles blocks of voxels to a smooth field. Blocks that contain the same voxels agree on it, to the bit.
//
// A sample lies on every voxel, or, at levels with cells of at least two or four voxels, on every second or fourth
// along each axis, at world indices that are multiples of this step, so that all blocks and all chunks of a level use
// the same samples. Its value is (1/2 - s) times 2 (4 on every fourth) voxel edges, where s is the solid share of the
// surrounding voxels, weighted by a tent along each axis that ends two (four) voxels away. At steps of one and two
// voxels, the voxel itself decides on which side of the surface the sample lies, at least a quarter of an edge away:
// the field agrees with the automaton at each sampled voxel. No value is farther than 7/8 of an edge from 0.
//
// The shape is max(samples, box), and the box extends one edge beyond its cell: where it is as near to 0 as a sample
// can be, the neighbour's box is not. So the union of neighbours is the samples' own value, to the bit, wherever all
// neighbours are present.

#include <memory_resource>
#include <optional>
#include <vector>

#include "derive/shape.h"
#include "field/lattice.h"

namespace sgm {

/// True if blocks are visible at levels with cells of this edge, in units (AutomatonLimits::coarsest_voxels).
bool voxelsShow(const VoxelBlock& block, int32_t cell);

/// Fills `samples`, in whole units, and returns their lattice: the samples that determine the shape within the box
/// `read`. nullopt if the block's box alone determines it. shape: of kind voxels, one of the chunk's shapes.
std::optional<SampleLattice> sampleVoxels(const GrammarChunk& chunk, const Shape& shape, const IntBox& read,
                                          int32_t cell, std::pmr::vector<float>& samples);

}  // namespace sgm
