#pragma once
// Computes texture coordinates for the vertices of a mesh. A vertex at the border of charts gets several wedges (copies
// with different coordinates); the triangles and their adjacency do not change.

#include <functional>
#include <memory_resource>
#include <span>

#include "texture/material_blend.h"
#include "texture/texture_space.h"
#include "texture/unwrapped.h"

namespace sgm {

struct UnwrapInput {
  std::span<const TexturePoint> positions;  ///< world positions in units
  std::span<const uint32_t> labels;         ///< shape that makes the surface, one label per vertex
  std::span<const uint32_t> indices;        ///< three per triangle, counter-clockwise seen from the void
  std::function<const TextureSpace&(uint32_t label)> space_of;
  std::span<const TexturePoint> normals;   ///< one per vertex, any length
  std::span<const MaterialMix> materials;  ///< one per vertex
  /// number of indices before the seams' triangles, which are flat in a face of the chunk
  size_t body_indices = SIZE_MAX;
};

/// A non-periodic coordinate is moved by a multiple of this many tiles, so that it is within half of it: floats then
/// resolve a 4,096th of a tile.
inline constexpr double kTilesKept = 4096;

/// Computes the wedges. A triangle uses the space of the shape that makes two of its vertices or, if all differ, that
/// of its first vertex. It uses one chart of that space, selected by the direction in which the triangle faces or, for
/// a seam, by its vertices' normals. It has at most two materials (material_blend.h). Pure. Throws std::bad_alloc.
Unwrapped unwrap(const UnwrapInput& mesh, std::pmr::memory_resource* memory);

/// Computes wedges without coordinates: a vertex has one wedge for each pair of materials of its triangles. u, v and
/// plane_shares are 0. indices: three per triangle; materials: one per vertex. Pure. Throws std::bad_alloc.
Unwrapped pairMaterials(std::span<const uint32_t> indices, std::span<const MaterialMix> materials,
                        std::pmr::memory_resource* memory);

/// How evenly a texture lies on a mesh: tiles per length of a tile on the surface. 1 is the intended density.
struct TexelDensity {
  double low = 0, middle = 0, high = 0;  ///< percentiles, weighted by area: 5 %, 50 % and 95 %
  /// additional wedges (beyond one per vertex), divided by the number of vertices in triangles
  double seams = 0;
};
/// Measures the density. tile: edge of a tile in units. Returns all 0 for a mesh without area.
TexelDensity texelDensity(const UnwrapInput& mesh, const Unwrapped& unwrapped, int32_t tile);

}  // namespace sgm
