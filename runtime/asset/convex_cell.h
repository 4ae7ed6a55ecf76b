#pragma once
// Convex polygons and bodies that planes split: what a BSP tree cuts space into.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "asset/point.h"

namespace sgm::asset {

/// A convex polygon in a plane; fewer than three corners: nothing.
using Loop = std::vector<Point>;

/// The part of a loop behind a plane. Corners nearer to it than the tolerance lie in it.
Loop clippedLoop(const Loop& loop, const Plane& plane, double tolerance);
/// The square in a plane with its middle nearest to `about`.
Loop squareIn(const Plane& plane, Point about, double half_edge);
double areaOf(const Loop& loop);
Point middleOf(const Loop& loop);

/// What lies behind all of its facets' planes.
struct ConvexCell {
  struct Facet {
    Plane plane;
    Loop loop;
  };
  std::vector<Facet> facets;

  static ConvexCell box(Point low, Point high);
  /// The mean of its corners.
  Point middle() const;
  double volume() const;
  /// Of all corners: the least and the largest distance from a plane.
  std::pair<double, double> range(const Plane& plane) const;
};

/// The parts behind a plane and before it; nothing where that part is thinner than the tolerance.
struct SplitCell {
  std::optional<ConvexCell> behind, before;
};
SplitCell splitCell(const ConvexCell& cell, const Plane& plane, double tolerance);

}  // namespace sgm::asset
