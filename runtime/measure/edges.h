#pragma once
// Which triangles meet along each edge.

#include <cstdint>
#include <span>

#include "base/large_pages.h"
#include "measure/triangles.h"

namespace sgm::measure {

/// Side k of triangle i, from its corner k to the next one, is the half edge 3 i + k; so a half edge also names the
/// corner that it begins at.
using HalfEdge = uint32_t;

inline HalfEdge nextHalf(HalfEdge half) { return half % 3 == 2 ? half - 2 : half + 1; }
inline uint32_t beginOf(std::span<const Triangle> triangles, HalfEdge half) { return triangles[half / 3][half % 3]; }
inline uint32_t endOf(std::span<const Triangle> triangles, HalfEdge half) {
  return triangles[half / 3][(half % 3 + 1) % 3];
}

/// Half edges grouped by the edge they lie on, whatever their direction; edges rise by their lower vertex, then their
/// higher one, half edges of one edge by number. Triangles with a corner twice have none.
class Edges {
 public:
  /// Contract: at most 2^32 / 3 triangles. About 12 bytes a half edge.
  explicit Edges(const Triangles& mesh);

  size_t count() const { return start_.size() - 1; }
  std::span<const HalfEdge> around(size_t edge) const {
    return {halves_.data() + start_[edge], start_[edge + 1] - start_[edge]};
  }

 private:
  LargeVector<HalfEdge> halves_;
  LargeVector<uint32_t> start_;  ///< of each edge, and the end
};

}  // namespace sgm::measure
