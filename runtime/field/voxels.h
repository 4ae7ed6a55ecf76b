#pragma once
// Blocks of voxels as a field: smooth, and the same in every block that holds the same voxels.
//
// A sample stands on every voxel, or, at levels with cells of two or four voxels and more, on every second or fourth
// along each axis: where the index in the whole world is a multiple of that, so that all blocks and all chunks of a
// level read the same samples. Its value is (1/2 - s) times 2 (4 on every fourth) voxel edges, where s is the solid
// share of the voxels around, weighted by a tent along each axis that ends two (four) voxels away. On every voxel and
// every second one the voxel itself decides on which side of the surface the sample lies, at least a quarter of an edge
// from it: what the automaton says of a voxel the field says at its place. No value is farther than 7/8 of an edge from
// 0.
//
// The shape is max(samples, box), and the box reaches one edge beyond the cell that it belongs to: where it is as near
// to 0 as a sample can be, the neighbour's box is not. So the union of neighbours is the samples' own value, to the
// bit, wherever they are all there.

#include <memory_resource>
#include <optional>
#include <vector>

#include "derive/shape.h"
#include "field/lattice.h"

namespace sgm {

/// Whether levels with cells of this edge, in units, have the block's voxels at all (AutomatonLimits::coarsest_voxels).
bool voxelsShow(const VoxelBlock& block, int32_t cell);

/// Fills `samples`, in whole units, and says where they stand: those that decide about the shape within `read`.
/// Nothing where the box alone does. shape: of kind voxels, of the chunk.
std::optional<SampleLattice> sampleVoxels(const GrammarChunk& chunk, const Shape& shape, const IntBox& read,
                                          int32_t cell, std::pmr::vector<float>& samples);

}  // namespace sgm
