#pragma once
// Where the vertices of a chunk would lie on the next coarser level's surface, for engines that blend levels.

#include <array>
#include <memory_resource>
#include <vector>

#include "base/result.h"
#include "mesh/packed_mesh.h"
#include "world/world_field.h"

namespace sgm {

/// From a vertex towards the coarser level's surface, in 1/256 of the chunk's cell edge.
using MorphOffset = std::array<int16_t, 3>;

/// The longest offset on an axis: two cells of the coarser level.
inline constexpr int kMostMorph = 4 * kSubcell;

/// One for each vertex: a Newton step on the field of the next coarser level, which is a pure function of where the
/// vertex lies and of its chunk's level. So chunks of a level that share a vertex give it one offset. 0 for the
/// vertices of a seam that are the coarser level's or join the two: these do not move, so a coarse chunk must not be
/// blended where it meets a finer one. 0 too where the coarser level has no surface within kMostMorph. On the highest
/// level all are 0. Errors: those of WorldField::compile. Throws std::bad_alloc.
Result<std::pmr::vector<MorphOffset>> morphOffsets(const WorldField& world, const PackedMesh& mesh,
                                                   const ChunkGrid& grid, const EditSnapshot* edits,
                                                   std::pmr::memory_resource* memory);

}  // namespace sgm
