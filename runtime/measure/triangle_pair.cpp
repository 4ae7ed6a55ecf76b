#include "measure/triangle_pair.h"

#include <cmath>
#include <optional>

#include "measure/exact_sign.h"

namespace sgm::measure {
namespace {

/// Signs of doubles, exact.
struct ExactSigns {
  using Place = Point;

  static int orientation(Point a, Point b, Point c, Point d) { return measure::orientation(a, b, c, d); }
  static int orientationAlong(int drop, Point a, Point b, Point c) { return measure::orientationAlong(drop, a, b, c); }
  /// The axis along which it is seen largest, so that the sign is quick to tell.
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

using Corners = std::array<Point, 3>;

Corners cornersOf(std::span<const Point> points, const Triangle& t) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}

}  // namespace

bool isFlat(std::span<const Point> points, const Triangle& t) {
  return ExactSigns::seenAlong(cornersOf(points, t)) < 0;
}

PairFault pairFault(std::span<const Point> points, Triangle a, Triangle b) {
  const int shared = sharedFirst(a, b);
  return TrianglePair<ExactSigns>::faultOf(cornersOf(points, a), cornersOf(points, b), shared);
}

PairFault pairFault(std::array<Point, 3> a, std::array<Point, 3> b) {
  const int shared = sharedFirst(a, b);
  return TrianglePair<ExactSigns>::faultOf(a, b, shared);
}

bool pierce(const std::array<Point, 3>& a, const std::array<Point, 3>& b) {
  return TrianglePair<ExactSigns>::pierce(a, b);
}

}  // namespace sgm::measure
