#pragma once
// Whether two triangles of a mesh meet where they should not: one definition, for integers and for doubles.
//
// Geometry has
//   Point                             a place, whose coordinates p[0..2] compare as numbers
//   orientation(a, b, c, d)           the sign of a volume: 1, 0 or -1; 0 where the four lie in one plane
//   orientationAlong(drop, a, b, c)   the sign of the area of the triangle, seen along the axis `drop`
// both exact.

#include <algorithm>
#include <array>
#include <cstddef>

namespace sgm {

template <class Geometry>
class TriangleMeeting {
 public:
  using Point = typename Geometry::Point;
  using Corners = std::array<Point, 3>;

  /// An axis along which the triangle is seen with an area; -1 if its corners lie on a line.
  static int dropOf(const Corners& t) {
    for (int axis = 0; axis < 3; ++axis)
      if (Geometry::orientationAlong(axis, t[0], t[1], t[2]) != 0) return axis;
    return -1;
  }

  /// Whether they have a point in common beside their `common` corners, which stand first in both, in the same order:
  ///  - with none in common: any point, touching included;
  ///  - with one: any other point;
  ///  - with two: if they lie in one plane on the same side of the common edge (a fold of 180 degrees).
  /// With three they are duplicates, and false. Triangles without area meet nothing.
  static bool meetWrongly(const Corners& a, const Corners& b, size_t common) {
    switch (common) {
      case 0:
        return meetApart(a, b);
      case 1:
        return meetBesideCorner(a, b);
      case 2:
        return foldBack(a, b);
      default:
        return false;
    }
  }

 private:
  static int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
    return Geometry::orientation(a, b, c, d);
  }
  static int along(int drop, const Point& a, const Point& b, const Point& c) {
    return Geometry::orientationAlong(drop, a, b, c);
  }

  /// In the plane of the triangle, seen along `drop`.
  static bool inTriangle(int drop, const Corners& t, const Point& p) {
    const int turn = along(drop, t[0], t[1], t[2]);
    for (size_t k = 0; k < 3; ++k)
      if (turn * along(drop, t[k], t[(k + 1) % 3], p) < 0) return false;
    return true;
  }

  /// Of points on one line.
  static bool between(const Point& a, const Point& b, const Point& p) {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < std::min(a[axis], b[axis]) || p[axis] > std::max(a[axis], b[axis])) return false;
    return true;
  }

  static bool segmentsMeet(int drop, const Point& a, const Point& b, const Point& c, const Point& d) {
    const int c_side = along(drop, a, b, c), d_side = along(drop, a, b, d);
    const int a_side = along(drop, c, d, a), b_side = along(drop, c, d, b);
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    return (c_side == 0 && between(a, b, c)) || (d_side == 0 && between(a, b, d)) ||
           (a_side == 0 && between(c, d, a)) || (b_side == 0 && between(c, d, b));
  }

  /// from_side, to_side: of the triangle's plane, by orientation().
  static bool segmentMeets(const Point& from, const Point& to, int from_side, int to_side, const Corners& t, int drop) {
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

  static std::array<int, 3> sidesOf(const Corners& plane, const Corners& t) {
    std::array<int, 3> sides{};
    for (size_t k = 0; k < 3; ++k) sides[k] = orientation(plane[0], plane[1], plane[2], t[k]);
    return sides;
  }

  static bool allOnOneSide(const std::array<int, 3>& sides) {
    return sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2];
  }

  static bool anyEdgeMeets(const Corners& a, const std::array<int, 3>& a_sides, const Corners& b, int b_drop) {
    for (size_t k = 0; k < 3; ++k) {
      const size_t next = (k + 1) % 3;
      if (segmentMeets(a[k], a[next], a_sides[k], a_sides[next], b, b_drop)) return true;
    }
    return false;
  }

  static bool meetApart(const Corners& a, const Corners& b) {
    const std::array<int, 3> b_sides = sidesOf(a, b);
    if (allOnOneSide(b_sides)) return false;
    const std::array<int, 3> a_sides = sidesOf(b, a);
    if (allOnOneSide(a_sides)) return false;
    const int a_drop = dropOf(a), b_drop = dropOf(b);
    if (a_drop < 0 || b_drop < 0) return false;
    return anyEdgeMeets(a, a_sides, b, b_drop) || anyEdgeMeets(b, b_sides, a, a_drop);
  }

  /// If they meet beside the common corner, the edge of one that lies opposite it meets the other: a line in both
  /// triangles from the common corner on ends at such an edge.
  static bool meetBesideCorner(const Corners& a, const Corners& b) {
    const int b1 = orientation(a[0], a[1], a[2], b[1]), b2 = orientation(a[0], a[1], a[2], b[2]);
    if (b1 * b2 > 0) return false;
    const int a1 = orientation(b[0], b[1], b[2], a[1]), a2 = orientation(b[0], b[1], b[2], a[2]);
    if (a1 * a2 > 0) return false;
    const int a_drop = dropOf(a), b_drop = dropOf(b);
    if (a_drop < 0 || b_drop < 0) return false;
    return segmentMeets(b[1], b[2], b1, b2, a, a_drop) || segmentMeets(a[1], a[2], a1, a2, b, b_drop);
  }

  static bool foldBack(const Corners& a, const Corners& b) {
    if (orientation(a[0], a[1], a[2], b[2]) != 0) return false;
    const int drop = dropOf(a);
    if (drop < 0 || dropOf(b) < 0) return false;
    return along(drop, a[0], a[1], a[2]) == along(drop, a[0], a[1], b[2]);
  }
};

}  // namespace sgm
