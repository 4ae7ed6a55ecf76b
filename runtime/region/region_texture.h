#pragma once
// Texture coordinates of a region's mesh: what the C interface's surfaces and the command's files and pictures have.

#include <functional>

#include "base/jobs.h"
#include "base/result.h"
#include "mesh/weld.h"
#include "texture/unwrap.h"
#include "world/chunk_key.h"
#include "world/world_field.h"

namespace sgm {

/// A region's mesh as its charts and its pairs of materials see it.
struct TexturedRegion {
  Unwrapped unwrapped;
  TexelDensity density;
};

/// The chunk whose level decides about a place, units. Called from one thread.
using ChunkAt = std::function<ChunkKey(Int3 place)>;

/// The chunk of that level of the world that the place is in.
ChunkAt chunksOfLevel(const WorldField& world, int level);

/// One coordinate system for the whole region, so that a vertex between two chunks has one place in a chart. tile: the
/// edge that coordinates count, units. Errors: those of WorldField::compileShapes and compile. Throws std::bad_alloc.
Result<TexturedRegion> unwrapRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh,
                                    const ChunkAt& chunk_at, int32_t tile);

/// The same without coordinates, as pairMaterials makes it: a texture's space is not looked for.
Result<Unwrapped> blendRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh, const ChunkAt& chunk_at);

}  // namespace sgm
