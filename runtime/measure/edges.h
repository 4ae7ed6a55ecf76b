#pragma once
// Finds, for each edge of a mesh, the triangles that meet along this edge.

#include <cstdint>
#include <span>

#include "base/large_pages.h"
#include "measure/triangles.h"

namespace sgm::measure {

/// Side k of triangle i, from its corner k to the next corner, is the half edge 3 i + k. A half edge also identifies
/// the corner at which it begins.
using HalfEdge = uint32_t;

inline HalfEdge nextHalf(HalfEdge half) { return half % 3 == 2 ? half - 2 : half + 1; }
inline uint32_t beginOf(std::span<const Triangle> triangles, HalfEdge half) { return triangles[half / 3][half % 3]; }
inline uint32_t endOf(std::span<const Triangle> triangles, HalfEdge half) {
  return triangles[half / 3][(half % 3 + 1) % 3];
}

/// The half edges of a mesh, grouped by their undirected edge. Edges are sorted by their lower vertex, then by their
/// higher vertex; half edges of one edge by number. Triangles with a repeated corner have no half edges here.
class Edges {
 public:
  /// Precondition: at most 2^32 / 3 triangles. Uses about 12 bytes of memory per half edge.
  explicit Edges(const Triangles& mesh);

  size_t count() const { return start_.size() - 1; }
  std::span<const HalfEdge> around(size_t edge) const {
    return {halves_.data() + start_[edge], start_[edge + 1] - start_[edge]};
  }

 private:
  LargeVector<HalfEdge> halves_;
  LargeVector<uint32_t> start_;  ///< start of each edge's group in halves_, and the end of the last group
};

}  // namespace sgm::measure
