#pragma once
// The integer sums over one part's triangles from which area and volume are computed: equal on every backend.

#include <array>
#include <cstdint>
#include <span>

#include "mesh/chunk.h"

namespace sgm {

/// Sums over a part's triangles. Lengths are in 1/256 of the chunk's cell, from the chunk's origin.
struct PartSums {
  uint32_t triangles = 0;
  /// sum of twice the triangles' areas, in 1/4096 of the square of a length unit (fixedRoot in triangle_terms.h)
  int64_t area = 0;
  std::array<int64_t, 3> cross{};  ///< sum of the cross products of the triangles' sides: twice the area vector
  /// sum of six times the signed volumes of the tetrahedra between triangles and chunk origin
  int64_t six_volumes = 0;

  friend bool operator==(const PartSums&, const PartSums&) = default;
};

/// Computes the sums of one part. Precondition: indices are below vertices.size(), and positions are in the range that
/// triangle_terms.h requires.
PartSums sumsOf(std::span<const Vertex> vertices, std::span<const uint32_t> indices);

/// Converts the area to square metres. cell: the chunk's cell edge, in units.
double areaOf(const PartSums& sums, int32_t cell);

/// Returns a third of the flux of the position vector, in cubic metres. Over a closed surface these values add up to
/// the enclosed volume. cell: the chunk's cell edge, in units. origin: the chunk's origin in metres from the point
/// about which the flux is taken, which must be the same for all parts.
double fluxOf(const PartSums& sums, int32_t cell, const std::array<double, 3>& origin);

}  // namespace sgm
