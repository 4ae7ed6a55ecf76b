#pragma once
// Defects of two triangles of a mesh in doubles, exactly as defined in mesh/triangle_faults.h.

#include "measure/triangles.h"
#include "mesh/triangle_faults.h"

namespace sgm::measure {

/// Tests two triangles. A corner is common to both if it has the same index in both, so points at equal positions must
/// have been merged before (weld_points.h); otherwise the triangles count as touching. A triangle without area neither
/// folds onto nor cuts another one.
PairFault pairFault(std::span<const Point> points, Triangle a, Triangle b);
inline bool meetWrongly(std::span<const Point> points, const Triangle& a, const Triangle& b) {
  return pairFault(points, a, b) != PairFault::none;
}

/// Same as the function above, for positions: corners are common if their positions are equal.
PairFault pairFault(std::array<Point, 3> a, std::array<Point, 3> b);
/// True if an edge of one triangle pierces the other triangle: its ends lie on both sides of the other triangle's
/// plane, and it passes through the other triangle's interior.
bool pierce(const std::array<Point, 3>& a, const std::array<Point, 3>& b);

inline bool hasCornerTwice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }
/// True if the corners lie on a line (or in a point).
bool isFlat(std::span<const Point> points, const Triangle& t);

}  // namespace sgm::measure
