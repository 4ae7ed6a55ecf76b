#pragma once
// On which side? Answered exactly.
//
// A determinant is computed in double first; where its rounding error could change the sign (error bounds of Shewchuk,
// Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997) it is computed again as a
// sum of doubles without any rounding. Exact while no product of three differences over- or underflows: for coordinates
// that are 0 or whose size lies between 1e-70 and 1e100.

#include "asset/point.h"

namespace sgm::asset {

/// 1, 0 or -1: d lies behind, in or in front of the plane in which a, b, c go round counter-clockwise seen from in
/// front.
int orientation(Point a, Point b, Point c, Point d);

/// 1, 0 or -1: a, b, c go round counter-clockwise, lie on a line, or go round clockwise, where `drop` and the two axes
/// after it in the order x, y, z, x, y are right-handed and the triangle is seen from the end of the axis `drop`
/// (0..2).
int orientationAlong(int drop, Point a, Point b, Point c);

}  // namespace sgm::asset
