#pragma once
// Exact predicates: on which side does a point lie?
//
// A determinant is computed in double first. If its rounding error could change the sign (error bounds of Shewchuk,
// Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997), it is computed again as a
// sum of doubles without any rounding. Exact as long as no product of three differences over- or underflows, as for
// coordinates that are 0 or have a magnitude between 1e-70 and 1e100.

#include "asset/point.h"

namespace sgm::asset {

/// Returns 1, 0 or -1 if d lies behind, in or in front of the plane of a, b, c, which are counter-clockwise seen from
/// the front.
int orientation(Point a, Point b, Point c, Point d);

/// Returns 1, 0 or -1 if a, b, c are counter-clockwise, collinear or clockwise, seen from the positive end of the axis
/// `drop` (0..2). `drop` and the two axes after it in the order x, y, z, x, y are right-handed.
int orientationAlong(int drop, Point a, Point b, Point c);

}  // namespace sgm::asset
