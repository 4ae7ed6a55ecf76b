#pragma once
// How many texels of a texture lie on a unit of surface.

#include <array>
#include <span>

#include "measure/triangles.h"

namespace sgm::measure {

/// Of a triangle: sqrt(area in texture coordinates * resolution^2 / area on the surface), texels a unit of length.
/// Values at shares of the area.
struct TexelDensities {
  uint64_t triangles = 0;     ///< whose density there is
  uint64_t without_area = 0;  ///< on the surface: left out
  uint64_t unmapped = 0;      ///< without area in the texture, stretched from a point or a line: left out
  double least = 0, p5 = 0, median = 0, p95 = 0, most = 0;

  /// How unevenly the texture lies: of the densest and the coarsest triangle. 1 where it is even, 0 without triangles.
  double ratio() const { return least > 0 ? most / least : 0; }
};

/// coordinates: in which a texture reaches from 0 to 1. corners: of each triangle of the mesh, into coordinates.
/// resolution: texels on the texture's edge. Coordinates that are no numbers count as unmapped.
TexelDensities texelDensities(const Triangles& mesh, std::span<const std::array<float, 2>> coordinates,
                              std::span<const Triangle> corners, double resolution);

}  // namespace sgm::measure
