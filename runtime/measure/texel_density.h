#pragma once
// The density of a texture's texels on the surface.

#include <array>
#include <span>

#include "measure/triangles.h"

namespace sgm::measure {

/// Percentiles, weighted by area, of the density of triangles: sqrt(area in texture coordinates * resolution^2 / area
/// on the surface), in texels per unit of length.
struct TexelDensities {
  uint64_t triangles = 0;     ///< triangles that have a density
  uint64_t without_area = 0;  ///< triangles without area on the surface: excluded
  uint64_t unmapped = 0;      ///< triangles without area in texture coordinates: excluded
  double least = 0, p5 = 0, median = 0, p95 = 0, most = 0;

  /// The unevenness: the density of the densest triangle divided by that of the least dense one. 1 if even, 0 without
  /// triangles.
  double ratio() const { return least > 0 ? most / least : 0; }
};

/// Measures a textured mesh. coordinates: the texture extends from 0 to 1. corners: for each triangle of the mesh,
/// indices into coordinates. resolution: texels along the texture's edge. Triangles with non-finite coordinates count
/// as unmapped.
TexelDensities texelDensities(const Triangles& mesh, std::span<const std::array<float, 2>> coordinates,
                              std::span<const Triangle> corners, double resolution);

}  // namespace sgm::measure
