#pragma once
// Points that are one place become one: files repeat a point for each triangle, or for each normal.

#include <cstddef>
#include <cstdint>

#include "base/large_pages.h"
#include "measure/triangles.h"

namespace sgm::measure {

struct WeldedPoints {
  LargeVector<Point> points;
  LargeVector<Triangle> triangles;  ///< as many as before, in their order
  size_t merged = 0;                ///< points that fell on another
};

/// tolerance 0: points with equal coordinates (0 and -0 are equal) are one. Otherwise each point, in order, falls on
/// the first kept one that is at most so far off; the tolerance is more than 0 and finite. Equal coordinates are the
/// right rule for what a program wrote: meshes of ours have vertices a 128th of a cell apart that are not one, which
/// the usual millionth of the diagonal merges in a region of a kilometre. Contract: the coordinates of points that
/// triangles use are finite. Points that none uses are left out.
WeldedPoints weldPoints(const Triangles& mesh, double tolerance = 0);

}  // namespace sgm::measure
