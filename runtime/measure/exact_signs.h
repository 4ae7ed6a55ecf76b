#pragma once
// The predicates on doubles for mesh/triangle_faults.h and mesh/column.h.

#include <array>
#include <cmath>

#include "measure/exact_sign.h"

namespace sgm::measure {

/// Signs of doubles, exact.
struct ExactSigns {
  using Place = Point;

  static int orientation(Point a, Point b, Point c, Point d) { return measure::orientation(a, b, c, d); }
  static int orientationAlong(int drop, Point a, Point b, Point c) { return measure::orientationAlong(drop, a, b, c); }
  /// The axis along which the triangle looks largest, so that the sign is quick to determine; -1 if it is flat.
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
