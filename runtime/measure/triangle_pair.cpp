#include "measure/triangle_pair.h"

#include <cmath>
#include <optional>

#include "measure/exact_signs.h"

namespace sgm::measure {
namespace {

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
