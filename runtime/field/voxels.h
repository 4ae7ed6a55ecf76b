#pragma once
// Compiles blocks of voxels to a smooth field. Blocks that contain the same voxels agree on it, to the bit.
//
// The field interpolates samples. At fine levels, there is a sample on every voxel; where cells are as long as two
// (four) voxels or longer, on every second (fourth) voxel along each axis. The indices of sampled voxels in the world
// are multiples of this step, so that all blocks and all chunks of a level use the same samples. The value of a sample
// is 2 (1/2 - s) voxel edges, or 4 (1/2 - s) if every fourth voxel is sampled. s is the solid share of the surrounding
// voxels, weighted by a tent along each axis that ends two (four) voxels away. At steps of one and two voxels, the sign
// of a sample is that of its own voxel, and its magnitude is at least a quarter of an edge, so that the field agrees
// with the automaton at each sampled voxel. The magnitude of a sample is at most 7/8 of an edge.
//
// The shape is max(samples, box). The box extends one edge beyond the block's cell, so its value can exceed a sample
// only less than one edge inside its faces, or outside of it. Such a position lies in the cell of a neighbouring block,
// at least one edge inside the neighbour's box, where the neighbour's shape equals the samples. So the union of
// neighbours equals the samples, to the bit, wherever all neighbours are present.

#include <memory_resource>
#include <optional>
#include <vector>

#include "derive/shape.h"
#include "field/lattice.h"

namespace sgm {

/// True if the block is visible at levels with cells of this edge, in units (AutomatonLimits::coarsest_voxels).
bool voxelsShow(const VoxelBlock& block, int32_t cell);

/// Writes the samples that determine the shape within the box `read` to `samples`, in whole units, and returns their
/// lattice. nullopt if the block's box alone determines the shape. shape: one of the chunk's shapes, of kind voxels.
std::optional<SampleLattice> sampleVoxels(const GrammarChunk& chunk, const Shape& shape, const IntBox& read,
                                          int32_t cell, std::pmr::vector<float>& samples);

}  // namespace sgm
