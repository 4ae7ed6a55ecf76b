#pragma once
// The orientation predicates for doubles, in the form that mesh/triangle_faults.h and mesh/column.h require.

#include <array>
#include <cmath>

#include "measure/exact_sign.h"

namespace sgm::measure {

/// Exact signs of predicates on doubles.
struct ExactSigns {
  using Place = Point;

  static int orientation(Point a, Point b, Point c, Point d) { return measure::orientation(a, b, c, d); }
  static int orientationAlong(int drop, Point a, Point b, Point c) { return measure::orientationAlong(drop, a, b, c); }
  /// Returns the axis along which the triangle's projection has the largest area, because its exact sign is computed
  /// fastest there; -1 if the triangle is flat.
  static int seenAlong(const std::array<Point, 3>& t) {
    const Point normal = asset::cross(t[1] - t[0], t[2] - t[0]);
    int best = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (std::fabs(normal[axis]) > std::fabs(normal[best])) best = axis;
    for (int n = 0; n < 3; ++n) {
      const int axis = (best + n) % 3;
      if (measure::orientationAlong(axis, t[0], t[1], t[2]) != 0) return axis;
    }
    return -1;
  }
};

}  // namespace sgm::measure
