#pragma once
// Gives texture coordinates to the vertices of a mesh. A vertex at the border of charts gets several wedges; the
// triangles and their adjacency do not change.

#include <functional>
#include <memory_resource>
#include <span>

#include "texture/material_blend.h"
#include "texture/texture_space.h"
#include "texture/unwrapped.h"

namespace sgm {

struct UnwrapInput {
  std::span<const TexturePoint> positions;  ///< world, units
  std::span<const uint32_t> labels;         ///< of the shapes that make the surface, one per vertex
  std::span<const uint32_t> indices;        ///< three per triangle, counter-clockwise seen from the void
  std::function<const TextureSpace&(uint32_t label)> space_of;
  std::span<const TexturePoint> normals;   ///< one per vertex, any length
  std::span<const MaterialMix> materials;  ///< one per vertex
  size_t body_indices = SIZE_MAX;          ///< the triangles after these are seams, flat in a chunk's face
};

/// Non-periodic coordinates stay within half of this many tiles of 0, by leaving out whole multiples, so that floats
/// resolve a 4,096th of a tile.
inline constexpr double kTilesKept = 4096;

/// A triangle uses the space of the shape that makes two of its vertices, or of its first vertex if there is none, and
/// one chart of it: by the direction in which the triangle faces, or its vertices' normals if it is a seam. It shows at
/// most two materials (material_blend.h). Pure. Throws std::bad_alloc.
Unwrapped unwrap(const UnwrapInput& mesh, std::pmr::memory_resource* memory);

/// The mesh without coordinates: one wedge of a vertex for each pair of materials that its triangles show. u, v and
/// plane_shares of wedges are 0. indices: three per triangle; materials: one per vertex. Pure. Throws std::bad_alloc.
Unwrapped pairMaterials(std::span<const uint32_t> indices, std::span<const MaterialMix> materials,
                        std::pmr::memory_resource* memory);

/// How evenly a texture lies on a mesh: tiles per tile length of surface. 1 is the intended density.
struct TexelDensity {
  double low = 0, middle = 0, high = 0;  ///< percentiles by area: 5 %, 50 % and 95 %
  double seams = 0;                      ///< wedges beyond one per vertex, as a share of the vertices in triangles
};
/// tile: its edge in units. Returns all 0 for a mesh without area.
TexelDensity texelDensity(const UnwrapInput& mesh, const Unwrapped& unwrapped, int32_t tile);

}  // namespace sgm
