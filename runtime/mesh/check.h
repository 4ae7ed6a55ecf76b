#pragma once
// Is a set of triangles a closed 2-manifold? Judged by vertex identity alone, never by position.

#include <cstddef>
#include <memory_resource>
#include <span>
#include <string>

#include "mesh/chunk.h"

namespace sgm {

struct MeshReport {
  size_t triangles = 0;
  size_t vertices = 0;              ///< that a triangle uses
  size_t edges = 0;                 ///< undirected
  size_t open_edges = 0;            ///< used by one triangle: the border
  size_t unmatched_edges = 0;       ///< used more often in one direction than in the other, the open ones included
  size_t repeated_edges = 0;        ///< used twice or more in one and the same direction
  size_t non_manifold_edges = 0;    ///< used by three triangles or more
  size_t pinched_vertices = 0;      ///< whose link is neither one cycle nor, at the border, one path
  size_t border_vertices = 0;       ///< whose link is one path
  size_t degenerate_triangles = 0;  ///< with a vertex twice; left out of the counts of edges and links
  size_t duplicate_triangles = 0;   ///< with the same three vertices as another, in any order, beyond the first

  /// A 2-manifold, consistently oriented, perhaps with a border.
  bool manifold() const {
    return unmatched_edges == open_edges && repeated_edges == 0 && non_manifold_edges == 0 && pinched_vertices == 0 &&
           degenerate_triangles == 0 && duplicate_triangles == 0;
  }
  /// And without a border: every edge once in each direction, every vertex link one cycle.
  bool closed() const { return manifold() && open_edges == 0; }
};

/// One line with the counts that are not 0.
std::string describe(const MeshReport& report);

/// indices: three a triangle, each below vertex_count (the caller's contract). About 0.2 us a triangle.
/// memory: for 8 bytes a vertex and 24 a triangle while it works; up to 16 a vertex more.
MeshReport checkTriangles(std::span<const uint32_t> indices, size_t vertex_count,
                          std::pmr::memory_resource* memory = std::pmr::new_delete_resource());

/// All triangles of the parts together; vertices with equal keys are one.
MeshReport checkParts(std::span<const MeshPart* const> parts);

}  // namespace sgm
