#pragma once
// Computes texture coordinates for the vertices of a mesh. A vertex at the border of charts gets several wedges (copies
// with different texture coordinates); the triangles and their adjacency do not change.

#include <functional>
#include <memory_resource>
#include <span>

#include "texture/material_blend.h"
#include "texture/texture_space.h"
#include "texture/unwrapped.h"

namespace sgm {

struct UnwrapInput {
  std::span<const TexturePoint> positions;  ///< world positions of the vertices, in units (1/1024 m)
  std::span<const uint32_t> labels;         ///< for each vertex: label of the shape that makes the surface there
  std::span<const uint32_t> indices;        ///< three vertex indices per triangle, counter-clockwise seen from the void
  std::function<const TextureSpace&(uint32_t label)> space_of;
  std::span<const TexturePoint> normals;   ///< one normal per vertex, not necessarily of unit length
  std::span<const MaterialMix> materials;  ///< materials around each vertex
  /// number of the body's indices, which come before the indices of the seams. A seam is a flat strip in a face of the
  /// chunk's box; it joins the chunk to coarser chunks.
  size_t body_indices = SIZE_MAX;
};

/// Number of tiles. Non-periodic coordinates are shifted by a multiple of this number into the range from -kTilesKept /
/// 2 to kTilesKept / 2, so that floats resolve 1/4,096 of a tile.
inline constexpr double kTilesKept = 4096;

/// Computes the wedges of a mesh. A triangle uses the texture space of the shape that makes two of its vertices or, if
/// three different shapes make its vertices, the texture space of the first vertex's shape. The triangle's own normal
/// selects the chart; in a seam between chunks, the normals of its vertices do. A triangle has at most two materials
/// (material_blend.h). Pure. Throws std::bad_alloc.
Unwrapped unwrap(const UnwrapInput& mesh, std::pmr::memory_resource* memory);

/// Computes wedges for materials only: a vertex has one wedge for each pair of materials of its triangles. u, v and
/// plane_shares are 0. indices: three per triangle; materials: one per vertex. Pure. Throws std::bad_alloc.
Unwrapped pairMaterials(std::span<const uint32_t> indices, std::span<const MaterialMix> materials,
                        std::pmr::memory_resource* memory);

/// The texel density over a mesh: tiles in texture space per tile length on the surface. 1 is the intended density.
struct TexelDensity {
  double low = 0, middle = 0, high = 0;  ///< percentiles 5 %, 50 % and 95 % of the density, weighted by area
  /// share of duplicated vertices: (wedges - vertices) / vertices, counting only vertices that triangles use
  double seams = 0;
};
/// Measures the texel density. tile: edge length of a tile in units (1/1024 m). Returns all 0 for a mesh without area.
TexelDensity texelDensity(const UnwrapInput& mesh, const Unwrapped& unwrapped, int32_t tile);

}  // namespace sgm
