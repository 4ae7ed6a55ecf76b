#pragma once
// The integer sums over one part's triangles from which area and volume are computed: equal on every backend.

#include <array>
#include <cstdint>
#include <span>

#include "mesh/chunk.h"

namespace sgm {

/// Lengths are in 1/256 of the chunk's cell, from the chunk's origin.
struct PartSums {
  uint32_t triangles = 0;
  int64_t area = 0;                ///< sum of twice the areas, each in 1/4096 (fixedRoot in triangle_terms.h)
  std::array<int64_t, 3> cross{};  ///< sum of the cross products: twice the area vector
  int64_t six_volumes = 0;         ///< six times the flux of x / 3 about the chunk's origin

  friend bool operator==(const PartSums&, const PartSums&) = default;
};

/// Precondition: indices are below vertices.size(), and positions in the range of triangle_terms.h.
PartSums sumsOf(std::span<const Vertex> vertices, std::span<const uint32_t> indices);

/// Square metres. cell: of the chunk, units.
double areaOf(const PartSums& sums, int32_t cell);

/// Cubic metres: a third of the flux of x about a point; the chunk's origin is `origin` metres from it. Over a closed
/// surface these add up to the enclosed volume.
double fluxOf(const PartSums& sums, int32_t cell, const std::array<double, 3>& origin);

}  // namespace sgm
