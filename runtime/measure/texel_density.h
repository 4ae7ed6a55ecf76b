#pragma once
// The density of a texture's texels on the surface.

#include <array>
#include <span>

#include "measure/triangles.h"

namespace sgm::measure {

/// The density of a triangle is sqrt(area in texture coordinates * resolution^2 / area on the surface), in texels per
/// unit of length. The values are percentiles by area.
struct TexelDensities {
  uint64_t triangles = 0;     ///< with a density
  uint64_t without_area = 0;  ///< on the surface: excluded
  uint64_t unmapped = 0;      ///< without area in the texture, stretched from a point or a line: excluded
  double least = 0, p5 = 0, median = 0, p95 = 0, most = 0;

  /// The unevenness: the ratio of the densest to the coarsest triangle. 1 if even, 0 without triangles.
  double ratio() const { return least > 0 ? most / least : 0; }
};

/// coordinates: a texture extends from 0 to 1. corners: of each triangle of the mesh, into coordinates. resolution:
/// texels along the texture's edge. Non-finite coordinates count as unmapped.
TexelDensities texelDensities(const Triangles& mesh, std::span<const std::array<float, 2>> coordinates,
                              std::span<const Triangle> corners, double resolution);

}  // namespace sgm::measure
