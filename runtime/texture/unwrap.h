#pragma once
// A mesh's vertices with texture coordinates. Where charts meet a vertex has several; triangles and what they share
// stay as they are.

#include <functional>
#include <memory_resource>
#include <span>

#include "texture/material_blend.h"
#include "texture/texture_space.h"
#include "texture/unwrapped.h"

namespace sgm {

struct UnwrapInput {
  std::span<const TexturePoint> positions;  ///< world, units
  std::span<const uint32_t> labels;         ///< of the shapes that make the surface, one a vertex
  std::span<const uint32_t> indices;        ///< three a triangle, counter-clockwise seen from the void
  std::function<const TextureSpace&(uint32_t label)> space_of;
  std::span<const TexturePoint> normals;   ///< one a vertex, any length
  std::span<const MaterialMix> materials;  ///< one a vertex
  size_t body_indices = SIZE_MAX;          ///< triangles behind these are of seams, flat in a chunk's face
};

/// Coordinates that do not come again lie within half of this many tiles of 0, so that floats hold them to a 4,096th:
/// whole multiples are left out.
inline constexpr double kTilesKept = 4096;

/// A triangle lies in the space of the shape that makes two of its vertices, else of its first one's, and in one chart
/// of it: by the way that it faces, or that its vertices do where it is of a seam. It shows two materials at most
/// (material_blend.h). Pure. Throws std::bad_alloc.
Unwrapped unwrap(const UnwrapInput& mesh, std::pmr::memory_resource* memory);

/// The mesh without coordinates: a vertex comes once for each pair of materials that its triangles show. u, v and
/// plane_shares of wedges are 0. indices: three a triangle; materials: one a vertex. Pure. Throws std::bad_alloc.
Unwrapped pairMaterials(std::span<const uint32_t> indices, std::span<const MaterialMix> materials,
                        std::pmr::memory_resource* memory);

/// How evenly a texture lies on a mesh: tiles on a tile's length of surface. 1: as it is meant.
struct TexelDensity {
  double low = 0, middle = 0, high = 0;  ///< 5 %, half and 95 % of the area have no more
  double seams = 0;                      ///< wedges beyond one a vertex, as a share of the vertices in triangles
};
/// tile: its edge in units. All 0 for a mesh without area.
TexelDensity texelDensity(const UnwrapInput& mesh, const Unwrapped& unwrapped, int32_t tile);

}  // namespace sgm
