#include "mesh/part_sums.h"

#include "mesh/triangle_terms.h"

namespace sgm {

PartSums sumsOf(std::span<const Vertex> vertices, std::span<const uint32_t> indices) {
  PartSums sums;
  sums.triangles = static_cast<uint32_t>(indices.size() / 3);
  for (size_t at = 0; at + 3 <= indices.size(); at += 3) {
    const TriangleTerms terms = termsOf(vertices[indices[at]], vertices[indices[at + 1]], vertices[indices[at + 2]]);
    sums.area += fixedRoot(terms.square);
    sums.cross[0] += terms.x;
    sums.cross[1] += terms.y;
    sums.cross[2] += terms.z;
    sums.six_volumes += terms.six_volumes;
  }
  return sums;
}

double areaOf(const PartSums& sums, int32_t cell) {
  const double step = static_cast<double>(cell) / (kSubcell * kUnitsPerMetre);
  return static_cast<double>(sums.area) / (2.0 * (1 << kLengthBits)) * step * step;
}

}  // namespace sgm
