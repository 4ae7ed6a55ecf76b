#pragma once
// What a check of the drawn surface counts.

#include <cstdint>

#include "mesh/check.h"

namespace sgm::cli {

struct FrameReport {
  uint64_t chunks = 0, triangles = 0;
  uint64_t edges = 0;                 ///< undirected
  uint64_t open_edges = 0;            ///< used more often in one direction than in the other
  uint64_t nonmanifold_edges = 0;     ///< used at least twice in one direction, as every edge of three triangles
  uint64_t degenerate_triangles = 0;  ///< triangles with a repeated vertex, whose edges do not count
  uint64_t flat_triangles = 0;        ///< of bodies, as are the next two, which count pairs within one part
  uint64_t folded_triangles = 0;      ///< pairs
  uint64_t self_intersections = 0;    ///< pairs
  uint64_t overlaps = 0;              ///< pairs of drawn chunks, one of which contains the other

  bool closed() const { return open_edges + nonmanifold_edges + degenerate_triangles + overlaps == 0; }
  bool valid() const { return closed() && flat_triangles + folded_triangles + self_intersections == 0; }
  friend bool operator==(const FrameReport&, const FrameReport&) = default;
};

struct WholeReport {
  FrameReport frame;  ///< counted anew: a difference to check() means a bug in the checker
  MeshReport mesh;    ///< including the links of all vertices
  /// Pairs of triangles of different parts: folds or cuts between bodies of one level, other parts that pierce each
  /// other.
  uint64_t between_parts = 0;

  bool closed() const { return frame.closed() && mesh.closed(); }
  bool valid() const { return closed() && frame.valid() && between_parts == 0; }
};

}  // namespace sgm::cli
