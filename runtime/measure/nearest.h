#pragma once
// The point of a mesh that is nearest to a given point.

#include <array>

#include "measure/bvh.h"

namespace sgm::measure {

/// Returns the point of a triangle that is nearest to `to`. The triangle may have no area. The result lies in the
/// triangle, up to rounding.
Point nearestOn(const std::array<Point, 3>& triangle, Point to);

struct Nearest {
  double distance = 0;
  Point place;
  uint32_t triangle = 0;
};

/// Finds the point of a mesh that is nearest to `to`. tree: the tree of the mesh's triangles; there must be at least
/// one triangle. guess: any triangle; the nearer it is, the sooner the search ends. It also decides which of several
/// equally near points is returned. Pure.
Nearest nearestOf(const Triangles& mesh, const Bvh& tree, Point to, uint32_t guess = 0);

}  // namespace sgm::measure
