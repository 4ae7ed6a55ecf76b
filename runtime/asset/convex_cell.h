#pragma once
// Convex polygons and bodies that are split by planes: the cells of a BSP tree.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "asset/point.h"

namespace sgm::asset {

/// A convex polygon in a plane; empty if it has fewer than three vertices.
using Loop = std::vector<Point>;

/// The part of a loop behind a plane. Vertices closer to the plane than the tolerance count as in it.
Loop clippedLoop(const Loop& loop, const Plane& plane, double tolerance);
/// The square in a plane whose middle is nearest to `about`.
Loop squareIn(const Plane& plane, Point about, double half_edge);
double areaOf(const Loop& loop);
Point middleOf(const Loop& loop);

/// The intersection of the half-spaces behind its facets' planes.
struct ConvexCell {
  struct Facet {
    Plane plane;
    Loop loop;
  };
  std::vector<Facet> facets;

  static ConvexCell box(Point low, Point high);
  /// The mean of its vertices.
  Point middle() const;
  double volume() const;
  /// The least and the largest distance of its vertices from a plane.
  std::pair<double, double> range(const Plane& plane) const;
};

/// The parts behind a plane and before it; nullopt if a part is thinner than the tolerance.
struct SplitCell {
  std::optional<ConvexCell> behind, before;
};
SplitCell splitCell(const ConvexCell& cell, const Plane& plane, double tolerance);

}  // namespace sgm::asset
