#include "measure/triangle_pair.h"

#include <cmath>
#include <optional>

#include "measure/exact_sign.h"

namespace sgm::measure {
namespace {

using Corners = std::array<Point, 3>;

Corners cornersOf(std::span<const Point> points, const Triangle& t) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}

/// The axis along which a triangle is seen largest; -1 where its corners lie on a line.
int dropOf(const Corners& t) {
  const Point normal = asset::cross(t[1] - t[0], t[2] - t[0]);
  int best = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::fabs(normal[axis]) > std::fabs(normal[best])) best = axis;
  for (int n = 0; n < 3; ++n) {
    const int axis = (best + n) % 3;
    if (orientationAlong(axis, t[0], t[1], t[2]) != 0) return axis;
  }
  return -1;
}

/// In the plane of the triangle, seen along `drop`.
bool inTriangle(int drop, const Corners& t, Point p) {
  const int turn = orientationAlong(drop, t[0], t[1], t[2]);
  for (size_t k = 0; k < 3; ++k)
    if (turn * orientationAlong(drop, t[k], t[(k + 1) % 3], p) < 0) return false;
  return true;
}

/// Of points on one line.
bool between(Point a, Point b, Point p) {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < std::fmin(a[axis], b[axis]) || p[axis] > std::fmax(a[axis], b[axis])) return false;
  return true;
}

bool segmentsMeet(int drop, Point a, Point b, Point c, Point d) {
  const int c_side = orientationAlong(drop, a, b, c), d_side = orientationAlong(drop, a, b, d);
  const int a_side = orientationAlong(drop, c, d, a), b_side = orientationAlong(drop, c, d, b);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && between(a, b, c)) || (d_side == 0 && between(a, b, d)) || (a_side == 0 && between(c, d, a)) ||
         (b_side == 0 && between(c, d, b));
}

/// from_side, to_side: of the triangle's plane, by orientation().
bool segmentMeets(Point from, Point to, int from_side, int to_side, const Corners& t, int drop) {
  if (from_side * to_side > 0) return false;
  if (from_side == 0 && to_side == 0) {
    if (inTriangle(drop, t, from) || inTriangle(drop, t, to)) return true;
    for (size_t k = 0; k < 3; ++k)
      if (segmentsMeet(drop, from, to, t[k], t[(k + 1) % 3])) return true;
    return false;
  }
  int seen = 0;
  for (size_t k = 0; k < 3; ++k) {
    const int side = orientation(from, to, t[k], t[(k + 1) % 3]);
    if (side * seen < 0) return false;
    if (side != 0) seen = side;
  }
  return true;
}

std::array<int, 3> sidesOf(const Corners& plane, const Corners& t) {
  std::array<int, 3> sides{};
  for (size_t k = 0; k < 3; ++k) sides[k] = orientation(plane[0], plane[1], plane[2], t[k]);
  return sides;
}

bool allOnOneSide(const std::array<int, 3>& sides) {
  return sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2];
}

bool anyEdgeMeets(const Corners& a, const std::array<int, 3>& a_sides, const Corners& b, int b_drop) {
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    if (segmentMeets(a[k], a[next], a_sides[k], a_sides[next], b, b_drop)) return true;
  }
  return false;
}

/// The corner that lies on the other side than the other two; nothing where one lies in the plane.
std::optional<size_t> loneCorner(const std::array<int, 3>& sides) {
  if (sides[0] == 0 || sides[1] == 0 || sides[2] == 0) return std::nullopt;
  return sides[0] == sides[1] ? 2 : sides[0] == sides[2] ? 1 : 0;
}

/// Both triangles cross the other's plane, in no corner. On the line of both planes each covers what lies between the
/// two edges from its lone corner; which of two edges comes first there is one orientation (Guigue and Devillers, Fast
/// and Robust Triangle-Triangle Overlap Test Using Orientation Predicates, 2003).
bool crossingMeet(const Corners& a, size_t a_lone, int a_side, const Corners& b, size_t b_lone, int b_side) {
  // As many turns as make both lone corners lie in front of the other plane.
  const Corners p = {a[a_lone], a[(a_lone + (b_side > 0 ? 2 : 1)) % 3], a[(a_lone + (b_side > 0 ? 1 : 2)) % 3]};
  const Corners q = {b[b_lone], b[(b_lone + (a_side > 0 ? 2 : 1)) % 3], b[(b_lone + (a_side > 0 ? 1 : 2)) % 3]};
  return orientation(p[0], p[1], q[0], q[1]) >= 0 && orientation(p[0], p[2], q[0], q[2]) <= 0;
}

bool meetApart(const Corners& a, const Corners& b) {
  const std::array<int, 3> b_sides = sidesOf(a, b);
  if (allOnOneSide(b_sides)) return false;
  const std::array<int, 3> a_sides = sidesOf(b, a);
  if (allOnOneSide(a_sides)) return false;
  const std::optional<size_t> a_lone = loneCorner(a_sides), b_lone = loneCorner(b_sides);
  if (a_lone && b_lone) return crossingMeet(a, *a_lone, a_sides[*a_lone], b, *b_lone, b_sides[*b_lone]);
  const int a_drop = dropOf(a), b_drop = dropOf(b);
  if (a_drop < 0 || b_drop < 0) return false;
  return anyEdgeMeets(a, a_sides, b, b_drop) || anyEdgeMeets(b, b_sides, a, a_drop);
}

/// The first corner of both is the common one. Where they meet elsewhere, the edge of one that lies opposite it meets
/// the other: a line in both triangles from the common corner on ends at such an edge.
bool meetBesideCorner(const Corners& a, const Corners& b) {
  const int b1 = orientation(a[0], a[1], a[2], b[1]), b2 = orientation(a[0], a[1], a[2], b[2]);
  if (b1 * b2 > 0) return false;
  const int a1 = orientation(b[0], b[1], b[2], a[1]), a2 = orientation(b[0], b[1], b[2], a[2]);
  if (a1 * a2 > 0) return false;
  const int a_drop = dropOf(a), b_drop = dropOf(b);
  if (a_drop < 0 || b_drop < 0) return false;
  return segmentMeets(b[1], b[2], b1, b2, a, a_drop) || segmentMeets(a[1], a[2], a1, a2, b, b_drop);
}

/// The first two corners of both are the common ones.
bool foldBack(const Corners& a, const Corners& b) {
  if (orientation(a[0], a[1], a[2], b[2]) != 0) return false;
  const int drop = dropOf(a);
  if (drop < 0 || dropOf(b) < 0) return false;
  return orientationAlong(drop, a[0], a[1], a[2]) == orientationAlong(drop, a[0], a[1], b[2]);
}

}  // namespace

bool isFlat(std::span<const Point> points, const Triangle& t) { return dropOf(cornersOf(points, t)) < 0; }

bool meetWrongly(std::span<const Point> points, const Triangle& a, const Triangle& b) {
  // The common corners first, in the same order in both.
  Triangle ordered_a = a, ordered_b = b;
  size_t common = 0;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = common; j < 3; ++j) {
      if (ordered_a[i] != ordered_b[j]) continue;
      std::swap(ordered_b[common], ordered_b[j]);
      std::swap(ordered_a[common], ordered_a[i]);
      ++common;
      break;
    }
  }
  const Corners first = cornersOf(points, ordered_a), second = cornersOf(points, ordered_b);
  switch (common) {
    case 0:
      return meetApart(first, second);
    case 1:
      return meetBesideCorner(first, second);
    case 2:
      return foldBack(first, second);
    default:
      return false;
  }
}

}  // namespace sgm::measure
