#include "mesh/part_sums.h"

#include "mesh/triangle_terms.h"

namespace sgm {

PartSums sumsOf(std::span<const Vertex> vertices, std::span<const uint32_t> indices) {
  TermSums sums;
  for (size_t at = 0; at + 3 <= indices.size(); at += 3)
    addTerms(termsOf(vertices[indices[at]], vertices[indices[at + 1]], vertices[indices[at + 2]]), sums);
  return {static_cast<uint32_t>(indices.size() / 3), sums.area, {sums.x, sums.y, sums.z}, sums.six_volumes};
}

double areaOf(const PartSums& sums, int32_t cell) {
  const double step = static_cast<double>(cell) / (kSubcell * kUnitsPerMetre);
  return static_cast<double>(sums.area) / (2.0 * (1 << kLengthBits)) * step * step;
}

double fluxOf(const PartSums& sums, int32_t cell, const std::array<double, 3>& origin) {
  // Positions are in 1/256 of a cell; the sums are exact in a double, except for extremely full chunks.
  const double step = static_cast<double>(cell) / (kSubcell * kUnitsPerMetre), square = step * step;
  double about_origin = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    about_origin += origin[axis] * (static_cast<double>(sums.cross[axis]) * square);
  return (static_cast<double>(sums.six_volumes) * square * step + about_origin) / 6;
}

}  // namespace sgm
