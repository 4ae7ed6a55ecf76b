#pragma once
// Defects of two triangles of a mesh in doubles, exactly as defined in mesh/triangle_faults.h.

#include "measure/triangles.h"
#include "mesh/triangle_faults.h"

namespace sgm::measure {

/// Tests two triangles. Their corners are common if they have the same index: equal points must have been merged before
/// (weld_points.h), or they count as touching. Triangles without area neither fold nor cut.
PairFault pairFault(std::span<const Point> points, Triangle a, Triangle b);
inline bool meetWrongly(std::span<const Point> points, const Triangle& a, const Triangle& b) {
  return pairFault(points, a, b) != PairFault::none;
}

/// Same as the function above, for positions: corners are common if their positions are equal.
PairFault pairFault(std::array<Point, 3> a, std::array<Point, 3> b);
/// True if an edge of one triangle has its ends on both sides of the other triangle's plane, and passes through its
/// interior.
bool pierce(const std::array<Point, 3>& a, const std::array<Point, 3>& b);

inline bool hasCornerTwice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }
/// True if the corners lie on a line (or in a point).
bool isFlat(std::span<const Point> points, const Triangle& t);

}  // namespace sgm::measure
