#pragma once
// Exact geometric predicates, which decide on which side of a plane or line a point lies.
//
// A determinant is computed in double first. If its rounding error could change the sign (error bounds of Shewchuk,
// Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997), it is computed again as a
// sum of doubles without any rounding. Exact as long as no product of three differences over- or underflows, as for
// coordinates that are 0 or have a magnitude between 1e-70 and 1e100.

#include "asset/point.h"

namespace sgm::asset {

/// Returns 1 if d lies behind the plane of a, b, c, 0 if in it, and -1 if in front of it. a, b, c are counter-clockwise
/// seen from the front.
int orientation(Point a, Point b, Point c, Point d);

/// Returns 1 if a, b, c are counter-clockwise, 0 if collinear, -1 if clockwise, seen from the positive end of the axis
/// `drop` (0..2). The coordinates of the projection are the two axes that follow `drop` cyclically.
int orientationAlong(int drop, Point a, Point b, Point c);

}  // namespace sgm::asset
