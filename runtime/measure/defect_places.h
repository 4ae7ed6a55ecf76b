#pragma once
// The places of defects in a mesh, so that they can be repaired: the first ones of each kind.

#include <string_view>
#include <vector>

#include "measure/edges.h"
#include "measure/nesting.h"
#include "measure/self_intersection.h"
#include "measure/shells.h"

namespace sgm::measure {

enum class DefectKind {
  open_edge,         ///< an edge of only one triangle that does not lie in a face of the cutting box (Cut)
  turned_edge,       ///< a misoriented edge: two triangles use it in the same direction
  nonmanifold_edge,  ///< an edge of three triangles or more
  pinched_vertex,    ///< a non-manifold vertex, where several fans meet
  degenerate,        ///< a triangle with two corners at the same position
  flat,              ///< a triangle whose corners lie on a line
  duplicate,         ///< a triangle with the same three vertices as another one
  inside_out,        ///< a closed shell that faces inward without being a cavity
  nested,            ///< a closed shell inside the solid of another shell
  folded,            ///< two triangles that overlap at a common edge
  self_intersection  ///< two triangles that intersect, or touch outside of their common corners and edge
};

/// Returns the name of a kind in the output of --json and in the service.
std::string_view nameOf(DefectKind kind);

struct DefectPlace {
  DefectKind kind = DefectKind::open_edge;
  uint32_t triangle = 0;  ///< index of a triangle that has the defect
  Point at;               ///< the middle of the edge or triangle, or the vertex
};

/// The box that a mesh was cut from: open edges in one of its faces are due to the cut, and not holes.
struct Cut {
  Point low, high;

  /// True if both points lie in the same face of the box.
  bool holds(Point a, Point b) const;
};

/// Returns the number of open edges that lie in a face of the cutting box.
uint64_t cutEdges(const Triangles& mesh, const Edges& edges, const Cut& cut);

/// Returns at most kMaxExamples defects of each kind: the ones at the edges, triangles or shells with the lowest
/// numbers. edges, parts, nesting: computed from this mesh. self_intersections: null if they were not searched. Takes
/// time linear in the size of the mesh.
std::vector<DefectPlace> defectPlaces(const Triangles& mesh, const Edges& edges, const Shells& parts,
                                      const Nesting& nesting, const SelfIntersections* self_intersections,
                                      const Cut* cut);

}  // namespace sgm::measure
