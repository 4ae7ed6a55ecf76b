#pragma once
// Texture coordinates of a region's mesh: what `--uv` adds to files and pictures.

#include <cstddef>
#include <vector>

#include "base/result.h"
#include "mesh/weld.h"
#include "stream/surface_shapes.h"

namespace sgm::cli {

/// A region's mesh as its charts see it.
struct TexturedRegion {
  Unwrapped unwrapped;
  TexelDensity density;
};

/// One coordinate system for the whole region, so that a vertex between two chunks has one place in a chart. tile: the
/// edge that coordinates count, units. Errors: those of WorldField::compileShapes.
Result<TexturedRegion> unwrapRegion(const WorldField& world, const WorldMesh& mesh, int level, int32_t tile);

/// What shows how a texture lies, as a .png file of one tile: 2 x 2 fields, a red line along u and a green one along v.
Result<std::vector<std::byte>> chequerPng();

}  // namespace sgm::cli
