#pragma once
// The places of defects in a mesh, the first ones of each kind, so that they can be repaired.

#include <string_view>
#include <vector>

#include "measure/edges.h"
#include "measure/nesting.h"
#include "measure/self_intersection.h"
#include "measure/shells.h"

namespace sgm::measure {

enum class DefectKind {
  open_edge,         ///< of only one triangle, not in the cut
  turned_edge,       ///< misoriented: two triangles use it in the same direction
  nonmanifold_edge,  ///< of three triangles or more
  pinched_vertex,    ///< non-manifold: several fans meet
  degenerate,        ///< a triangle with two corners in one place
  flat,              ///< a triangle whose corners lie on a line
  duplicate,         ///< a triangle that occurs twice
  inside_out,        ///< a closed shell
  nested,            ///< a closed shell inside the solid of another
  folded,            ///< two triangles that overlap at an edge
  self_intersection  ///< two triangles that intersect elsewhere
};

/// The name in --json and in the service.
std::string_view nameOf(DefectKind kind);

struct DefectPlace {
  DefectKind kind = DefectKind::open_edge;
  uint32_t triangle = 0;  ///< a triangle that has the defect
  Point at;               ///< the middle of the edge or of the triangle, or the vertex
};

/// The box that a mesh was cut from: open edges in one of its faces are not holes.
struct Cut {
  Point low, high;

  /// True if both points lie in the same face of it.
  bool holds(Point a, Point b) const;
};

/// The number of open edges that lie in the cut.
uint64_t cutEdges(const Triangles& mesh, const Edges& edges, const Cut& cut);

/// For each kind, the defects of the lowest edges, triangles or shells, at most kMostExamples. edges, parts, nesting:
/// of this mesh. self_intersections may be null. Linear in the size of the mesh.
std::vector<DefectPlace> defectPlaces(const Triangles& mesh, const Edges& edges, const Shells& parts,
                                      const Nesting& nesting, const SelfIntersections* self_intersections,
                                      const Cut* cut);

}  // namespace sgm::measure
