#pragma once
// Where a mesh is wrong: the first places of each kind, for who is to mend it.

#include <string_view>
#include <vector>

#include "measure/edges.h"
#include "measure/nesting.h"
#include "measure/self_intersection.h"
#include "measure/shells.h"

namespace sgm::measure {

enum class DefectKind {
  open_edge,         ///< of one triangle alone, not in the cut
  turned_edge,       ///< two triangles go along it in one direction
  nonmanifold_edge,  ///< of three triangles or more
  pinched_vertex,    ///< where several fans meet
  degenerate,        ///< a triangle with two corners in one place
  flat,              ///< a triangle whose corners lie on a line
  duplicate,         ///< a triangle that is there twice
  inside_out,        ///< a closed shell
  nested,            ///< a closed shell in the solid of another
  folded,            ///< two triangles that lie upon each other at an edge
  self_intersection  ///< two triangles that meet elsewhere
};

/// As --json and the service name it.
std::string_view nameOf(DefectKind kind);

struct DefectPlace {
  DefectKind kind = DefectKind::open_edge;
  uint32_t triangle = 0;  ///< one that has it
  Point at;               ///< the middle of the edge or of the triangle, or the vertex
};

/// The box that a mesh was cut from: open edges in one of its faces are no holes.
struct Cut {
  Point low, high;

  /// Whether both lie in one face of it.
  bool holds(Point a, Point b) const;
};

/// Open edges that lie in the cut.
uint64_t cutEdges(const Triangles& mesh, const Edges& edges, const Cut& cut);

/// Of each kind those of the lowest edges, triangles or shells, at most kMostExamples of them. edges, parts, nesting:
/// of this mesh. self_intersections may be null. Linear in the mesh.
std::vector<DefectPlace> defectPlaces(const Triangles& mesh, const Edges& edges, const Shells& parts,
                                      const Nesting& nesting, const SelfIntersections* self_intersections,
                                      const Cut* cut);

}  // namespace sgm::measure
