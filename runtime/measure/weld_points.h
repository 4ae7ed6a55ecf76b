#pragma once
// Merges points at the same position: files repeat a point for each triangle, or for each normal.

#include <cstddef>
#include <cstdint>

#include "base/large_pages.h"
#include "measure/triangles.h"

namespace sgm::measure {

struct WeldedPoints {
  LargeVector<Point> points;
  LargeVector<Triangle> triangles;  ///< the same triangles in the same order, with indices of welded points
  size_t merged = 0;                ///< points that were merged into others
};

/// Merges points. tolerance 0: points with equal coordinates (0 and -0 are equal) are merged. tolerance above 0
/// (finite): each point, in order, is merged into the first kept point at most that far away. A tolerance below the
/// rounding error of the mesh's largest coordinate counts as 0. For the files that this library generates, use 0: their
/// vertices may be only a 128th of a cell apart, and the usual tolerance, a millionth of the diagonal, would merge such
/// vertices in a region of a kilometre. Precondition: the coordinates of points that triangles use are finite. Unused
/// points are dropped.
WeldedPoints weldPoints(const Triangles& mesh, double tolerance = 0);

}  // namespace sgm::measure
