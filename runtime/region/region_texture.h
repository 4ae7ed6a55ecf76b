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

/// A region's mesh divided into charts and pairs of materials.
struct TexturedRegion {
  Unwrapped unwrapped;
  TexelDensity density;
};

/// Returns the chunk whose level applies at a place, units. Called from one thread.
using ChunkAt = std::function<ChunkKey(Int3 place)>;

/// For a level of the world: the chunk that contains the place.
ChunkAt chunksOfLevel(const WorldField& world, int level);

/// Unwraps the whole region in one coordinate system, so that a vertex between two chunks has one place in a chart.
/// tile: the edge that coordinates count in, units. Errors: those of WorldField::compileShapes and compile. Throws
/// std::bad_alloc.
Result<TexturedRegion> unwrapRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh,
                                    const ChunkAt& chunk_at, int32_t tile);

/// The same without coordinates, as pairMaterials makes it: does not search for texture spaces.
Result<Unwrapped> blendRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, const ChunkAt& chunk_at);

}  // namespace sgm
