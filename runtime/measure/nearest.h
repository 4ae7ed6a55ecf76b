#pragma once
// The point of a mesh that is nearest to a given point.

#include <array>

#include "measure/bvh.h"

namespace sgm::measure {

/// The nearest point of a triangle, which may have no area. The result lies in the triangle, up to rounding.
Point nearestOn(const std::array<Point, 3>& triangle, Point to);

struct Nearest {
  double distance = 0;
  Point place;
  uint32_t triangle = 0;
};

/// tree: of the same triangles, of which there is at least one. guess: any of them; the nearer it is, the sooner the
/// search ends. It also decides which of several equally near points is found. Pure.
Nearest nearestOf(const Triangles& mesh, const Bvh& tree, Point to, uint32_t guess = 0);

}  // namespace sgm::measure
