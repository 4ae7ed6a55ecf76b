#pragma once
// Measures the texel density: the number of texels of a texture for each unit of length on the surface.

#include <array>
#include <span>

#include "measure/triangles.h"

namespace sgm::measure {

/// Percentiles, weighted by area, of the density of triangles: sqrt(area in texture coordinates * resolution^2 / area
/// on the surface), in texels per unit of length.
struct TexelDensities {
  uint64_t triangles = 0;     ///< number of triangles that have a density
  uint64_t without_area = 0;  ///< number of triangles without area on the surface, which are excluded
  uint64_t unmapped = 0;      ///< number of triangles without area in texture coordinates, which are excluded
  double least = 0, p5 = 0, median = 0, p95 = 0, most = 0;

  /// The unevenness: the density of the densest triangle divided by that of the least dense one. 1 if even, 0 without
  /// triangles.
  double ratio() const { return least > 0 ? most / least : 0; }
};

/// Measures a textured mesh. coordinates: texture coordinates; the whole texture is the square from 0 to 1. corners:
/// for each triangle of the mesh, the indices of its corners in `coordinates`. resolution: texels along the texture's
/// edge. Triangles with non-finite coordinates count as unmapped.
TexelDensities texelDensities(const Triangles& mesh, std::span<const std::array<float, 2>> coordinates,
                              std::span<const Triangle> corners, double resolution);

}  // namespace sgm::measure
