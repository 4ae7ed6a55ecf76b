#pragma once
// Compiles blocks of voxels to a smooth field. Blocks that contain the same voxels agree on it, to the bit.
//
// The field interpolates samples. At fine levels, there is a sample on every voxel; where cells are as long as two
// (four) voxels or longer, on every second (fourth) voxel along each axis. The indices of sampled voxels in the world
// are multiples of this step, so that all blocks and all chunks of a level use the same samples. The value of a sample
// is 2 (1/2 - s) voxel edges, or 4 (1/2 - s) if every fourth voxel is sampled. s is the solid share of the surrounding
// voxels, weighted by a tent along each axis that ends two (four) voxels away. At steps of one and two voxels, the sign
// of a sample is that of its own voxel, and its magnitude is at least a quarter of an edge, so that the field agrees
// with the automaton at each sampled voxel. No sample is farther than 7/8 of an edge from 0.
//
// The shape is max(samples, box), and the box extends one edge beyond its cell. Where the value of one box is as near
// to 0 as a sample can be, the position is farther inside the neighbour's box. So the union of neighbours equals the
// samples, to the bit, wherever all neighbours are present.

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
