#pragma once
// The results of checks of the drawn surface.

#include <cstdint>

#include "mesh/check.h"

namespace sgm::cli {

struct FrameReport {
  uint64_t chunks = 0, triangles = 0;
  uint64_t edges = 0;              ///< number of undirected edges
  uint64_t open_edges = 0;         ///< edges that triangles use more often in one direction than in the other
  uint64_t nonmanifold_edges = 0;  ///< edges used at least twice in the same direction, for example by three triangles
  uint64_t degenerate_triangles = 0;  ///< triangles with a repeated vertex; their edges are not counted
  uint64_t flat_triangles = 0;        ///< triangles with zero area, in bodies of chunks
  uint64_t folded_triangles = 0;      ///< pairs of triangles of one body that fold onto each other
  uint64_t self_intersections = 0;    ///< pairs of triangles of one body that intersect
  uint64_t overlaps = 0;              ///< pairs of drawn chunks where one chunk contains the other

  bool closed() const { return open_edges + nonmanifold_edges + degenerate_triangles + overlaps == 0; }
  bool valid() const { return closed() && flat_triangles + folded_triangles + self_intersections == 0; }
  friend bool operator==(const FrameReport&, const FrameReport&) = default;
};

struct WholeReport {
  /// computed from scratch: if it differs from the result of FrameChecker::check(), the checker has a bug
  FrameReport frame;
  MeshReport mesh;  ///< topological check, including the links of all vertices
  /// Number of faulty pairs of triangles that belong to different parts or to the same seam; pairs within one body are
  /// not counted here. If the two triangles belong to bodies of the same level, folds and intersections are faults; in
  /// all other cases, only intersections are.
  uint64_t between_parts = 0;

  bool closed() const { return frame.closed() && mesh.closed(); }
  bool valid() const { return closed() && frame.valid() && between_parts == 0; }
};

}  // namespace sgm::cli
