#pragma once
// Convex polygons and convex polyhedra that are split by planes, for building BSP trees.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "asset/point.h"

namespace sgm::asset {

/// A convex polygon in a plane; empty if it has fewer than three vertices.
using Loop = std::vector<Point>;

/// Returns the part of a convex polygon behind a plane. Vertices closer to the plane than the tolerance count as lying
/// in it.
Loop clippedLoop(const Loop& loop, const Plane& plane, double tolerance);
/// Returns a square in the plane, centred on the point of the plane nearest to `about`.
Loop squareIn(const Plane& plane, Point about, double half_edge);
double areaOf(const Loop& loop);
Point middleOf(const Loop& loop);

/// A convex polyhedron: the intersection of the half-spaces behind its facets' planes.
struct ConvexCell {
  struct Facet {
    Plane plane;
    Loop loop;
  };
  std::vector<Facet> facets;

  static ConvexCell box(Point low, Point high);
  /// Returns the mean of the cell's vertices.
  Point middle() const;
  double volume() const;
  /// Returns the smallest and the largest signed distance of the cell's vertices from a plane.
  std::pair<double, double> range(const Plane& plane) const;
};

/// The parts of a cell behind and in front of a plane. A part is nullopt if it is thinner than the tolerance.
struct SplitCell {
  std::optional<ConvexCell> behind, before;
};
SplitCell splitCell(const ConvexCell& cell, const Plane& plane, double tolerance);

}  // namespace sgm::asset
