#pragma once
// Checks whether triangles form a closed 2-manifold. Only vertex identity counts, never position.

#include <cstddef>
#include <memory_resource>
#include <span>
#include <string>

#include "mesh/chunk.h"

namespace sgm {

struct MeshReport {
  size_t triangles = 0;
  size_t vertices = 0;            ///< vertices that a triangle uses
  size_t edges = 0;               ///< undirected
  size_t open_edges = 0;          ///< edges of exactly one triangle: the border
  size_t unmatched_edges = 0;     ///< edges used more often in one direction than in the other; includes open_edges
  size_t repeated_edges = 0;      ///< edges used twice or more in the same direction
  size_t non_manifold_edges = 0;  ///< edges of three triangles or more
  /// non-manifold vertices, whose link is neither one cycle nor, at the border, one path
  size_t pinched_vertices = 0;
  size_t border_vertices = 0;       ///< vertices on a border: their link is one path
  size_t degenerate_triangles = 0;  ///< triangles with a repeated vertex; ignored by the counts of edges and vertices
  size_t duplicate_triangles = 0;   ///< triangles with the same three vertices as an earlier triangle, in any order

  /// True if the mesh is a consistently oriented 2-manifold, with or without a border.
  bool manifold() const {
    return unmatched_edges == open_edges && repeated_edges == 0 && non_manifold_edges == 0 && pinched_vertices == 0 &&
           degenerate_triangles == 0 && duplicate_triangles == 0;
  }
  /// True if the mesh is a manifold without border: each edge is used once in each direction, and each vertex link is
  /// one cycle.
  bool closed() const { return manifold() && open_edges == 0; }
};

/// Formats the counts that are not 0 as one line.
std::string describe(const MeshReport& report);

/// Checks a triangle list. indices: three per triangle; precondition: each is less than vertex_count. Takes about 0.2
/// us per triangle. memory: source of temporary memory: 8 bytes per vertex and 24 bytes per triangle, and up to 16 more
/// bytes per vertex.
MeshReport checkTriangles(std::span<const uint32_t> indices, size_t vertex_count,
                          std::pmr::memory_resource* memory = std::pmr::new_delete_resource());

/// Checks all triangles of the parts together; vertices with equal keys are the same vertex.
MeshReport checkParts(std::span<const MeshPart* const> parts);

}  // namespace sgm
