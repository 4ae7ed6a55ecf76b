#pragma once
// What is wrong with two triangles of a mesh in doubles, as mesh/triangle_faults.h has it: exactly.

#include "measure/triangles.h"
#include "mesh/triangle_faults.h"

namespace sgm::measure {

/// Corners are common where they are so by number: points in one place are one before (weld_points.h), or touch.
/// Triangles without area fold and cut nothing.
PairFault pairFault(std::span<const Point> points, Triangle a, Triangle b);
inline bool meetWrongly(std::span<const Point> points, const Triangle& a, const Triangle& b) {
  return pairFault(points, a, b) != PairFault::none;
}

/// The same of single places, by which corners are common.
PairFault pairFault(std::array<Point, 3> a, std::array<Point, 3> b);
/// Whether an edge of one has its ends on both sides of the other, and goes through its inside.
bool pierce(const std::array<Point, 3>& a, const std::array<Point, 3>& b);

inline bool hasCornerTwice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }
/// Whether the corners lie on a line (or in a point).
bool isFlat(std::span<const Point> points, const Triangle& t);

}  // namespace sgm::measure
