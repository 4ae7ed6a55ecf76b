#pragma once
// Computes offsets from a chunk's vertices to the surface of the next coarser level, for engines that blend levels.

#include <array>
#include <memory_resource>
#include <vector>

#include "base/result.h"
#include "mesh/packed_mesh.h"
#include "world/world_field.h"

namespace sgm {

/// The vector from a vertex towards the coarser level's surface, in 1/256 of the chunk's cell edge.
using MorphOffset = std::array<int16_t, 3>;

/// The largest magnitude of an offset's component: two cells of the coarser level.
inline constexpr int kMaxMorph = 4 * kSubcell;

/// Returns one offset for each vertex: a Newton step on the field of the next coarser level. It is a pure function of
/// the vertex's position and the chunk's level, so chunks of one level agree on shared vertices.
///
/// The offset is 0 on the highest level; where the coarser level has no surface within kMaxMorph; and for those
/// vertices of a seam that belong to the coarser level or connect both levels. Such vertices do not move, so an engine
/// must not blend a coarse chunk where it meets a finer one. Errors: those of WorldField::compile. Throws
/// std::bad_alloc.
Result<std::pmr::vector<MorphOffset>> morphOffsets(const WorldField& world, const PackedMesh& mesh,
                                                   const ChunkGrid& grid, const EditSnapshot* edits,
                                                   std::pmr::memory_resource* memory);

}  // namespace sgm
