#pragma once
// Texture coordinates of a region's mesh, for the surfaces of the C interface and the files and pictures of the command
// line tool.

#include <functional>

#include "base/jobs.h"
#include "base/result.h"
#include "mesh/weld.h"
#include "texture/unwrap.h"
#include "world/chunk_key.h"
#include "world/world_field.h"

namespace sgm {

/// The texture coordinates of a region's mesh, and statistics of the texel density on its surface.
struct TexturedRegion {
  Unwrapped unwrapped;
  TexelDensity density;
};

/// Returns the chunk that contains a place (in units), in the level in which the region is meshed there. Not called
/// concurrently.
using ChunkAt = std::function<ChunkKey(Int3 place)>;

/// Returns a ChunkAt function for a mesh of a single level: it returns the chunk of this level that contains the place.
ChunkAt chunksOfLevel(const WorldField& world, int level);

/// Computes texture coordinates for the whole region in one coordinate system, so that a vertex between two chunks has
/// the same coordinates in both. tile: edge of a tile in units; coordinates increase by 1 per tile. Errors: those of
/// WorldField::compileShapes and compile. Throws std::bad_alloc.
Result<TexturedRegion> unwrapRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh,
                                    const ChunkAt& chunk_at, int32_t tile);

/// Computes only the blends of materials, without coordinates, as pairMaterials() does. This is faster, since texture
/// spaces are not needed.
Result<Unwrapped> blendRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, const ChunkAt& chunk_at);

}  // namespace sgm
