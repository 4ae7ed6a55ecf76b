#pragma once
// Texture coordinates of a region's mesh, for the C interface's surfaces and the command's files and pictures.

#include <functional>

#include "base/jobs.h"
#include "base/result.h"
#include "mesh/weld.h"
#include "texture/unwrap.h"
#include "world/chunk_key.h"
#include "world/world_field.h"

namespace sgm {

/// The texture coordinates of a region's mesh, and how evenly they are distributed.
struct TexturedRegion {
  Unwrapped unwrapped;
  TexelDensity density;
};

/// Returns the chunk whose level applies at a place (in units). Not called concurrently.
using ChunkAt = std::function<ChunkKey(Int3 place)>;

/// Returns a function for a world of a single level: the chunk that contains the place.
ChunkAt chunksOfLevel(const WorldField& world, int level);

/// Computes texture coordinates for the whole region in one coordinate system, so that a vertex between two chunks has
/// the same coordinates in both. tile: edge of a tile in units; coordinates increase by 1 per tile. Errors: those of
/// WorldField::compileShapes and compile. Throws std::bad_alloc.
Result<TexturedRegion> unwrapRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh,
                                    const ChunkAt& chunk_at, int32_t tile);

/// Computes only the blends of materials, without coordinates, as pairMaterials does. Does not search for texture
/// spaces, and so is faster.
Result<Unwrapped> blendRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, const ChunkAt& chunk_at);

}  // namespace sgm
