#pragma once
// Exact geometric predicates: on which side of a plane or line does a point lie? The determinant is first computed in
// double. If its rounding error could change the sign (error bounds: Shewchuk, "Adaptive Precision Floating-Point
// Arithmetic and Fast Robust Geometric Predicates", 1997), it is computed again, exactly, as a sum of doubles. The
// result is exact as long as no product of three differences over- or underflows, as for coordinates that are 0 or have
// a magnitude between 1e-70 and 1e100.

#include "asset/point.h"

namespace sgm::asset {

/// Returns the side of the plane through a, b and c on which d lies: 1 behind the plane, 0 in it, -1 in front of it.
/// The front is the side from which a, b, c appear counter-clockwise.
int orientation(Point a, Point b, Point c, Point d);

/// Projects the points along the axis `drop` (0..2) and returns 1 if a, b, c are counter-clockwise seen from the
/// positive end of that axis, 0 if collinear, -1 if clockwise. The projected coordinates are the two axes that follow
/// `drop` cyclically.
int orientationAlong(int drop, Point a, Point b, Point c);

}  // namespace sgm::asset
