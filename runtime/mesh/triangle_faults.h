#pragma once
// Defects of a triangle and of a pair of triangles. All checks use this definition: those of meshes, of streamed
// chunks, of drawn frames, and of measured regions and files.
//
// A triangle is
//   DEGENERATE  if two of its corners are the same, by index or by position;
//   FLAT        if its corners are three distinct points on a line.
// Two triangles that have an area
//   FOLD        if they share two corners and overlap: the angle between them is exactly 0;
//   CUT         if they have any common point other than their common corners and edge. Touching counts as
//               cutting.
// Two triangles that share all three corners are duplicates, which check.h reports. Every answer is exact.
//
// A file, a region of one level and the body of a chunk have none of these defects. A SEAM is a sheet of zero thickness
// in the face between two levels. If both levels have the same surface, the seam's triangles are flat, fold, and
// overlap others, and a corner of each level may have the same position, since keys distinguish them. So in seams only
// two conditions are defects: two corners of one triangle have the same position although they do not belong to
// different levels (maySharePlace); or a triangle PIERCES another one of any part: an edge whose ends lie on both sides
// of the other triangle's plane passes through its interior.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "mesh/feature_kind.h"

namespace sgm {

enum class PairFault : uint8_t { none, folded, cut };

/// True if two corners of a triangle of a seam may have the same position: one lies on the fine side of the seam, the
/// other on the coarse side. A lateral vertex lies on both. a, b: the corners' Vertex::kind.
constexpr bool maySharePlace(uint16_t a, uint16_t b) {
  const auto sides = [](uint16_t kind) { return kind == kLateralEdge ? 3 : isOfCoarserLevel(kind) ? 2 : 1; };
  return (sides(a) ^ sides(b)) == 3;
}

/// Exact side tests for positions whose coordinates differ by less than 2^19.
struct IntegerSigns {
  using Place = Int3;

  static constexpr int signOf(int64_t v) { return (v > 0) - (v < 0); }
  /// Returns 1 if d lies behind the plane of a, b, c, 0 if in it, and -1 if in front of it. a, b, c are
  /// counter-clockwise seen from the front.
  static int orientation(const Place& a, const Place& b, const Place& c, const Place& d) {
    const int64_t ux = a.x - d.x, uy = a.y - d.y, uz = a.z - d.z, vx = b.x - d.x, vy = b.y - d.y, vz = b.z - d.z,
                  wx = c.x - d.x, wy = c.y - d.y, wz = c.z - d.z;
    return signOf(ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx));
  }
  /// Returns 1 if a, b, c are counter-clockwise, 0 if collinear, -1 if clockwise, seen from the positive end of the
  /// axis `drop` (0..2).
  static int orientationAlong(int drop, const Place& a, const Place& b, const Place& c) {
    const int x = (drop + 1) % 3, y = (drop + 2) % 3;
    return signOf(int64_t{a[x] - c[x]} * (b[y] - c[y]) - int64_t{a[y] - c[y]} * (b[x] - c[x]));
  }
  /// Returns an axis (0..2) along which the triangle does not project to a line; -1 if it is flat.
  static int seenAlong(const std::array<Place, 3>& t) {
    for (int axis = 0; axis < 3; ++axis)
      if (orientationAlong(axis, t[0], t[1], t[2]) != 0) return axis;
    return -1;
  }
};

/// Intersection tests for two triangles. Signs: the orientation predicates, with the interface of IntegerSigns.
template <class Signs>
class TrianglePair {
 public:
  using Place = typename Signs::Place;
  using Corners = std::array<Place, 3>;

  /// Returns the defect of two triangles. shared: the number of their common corners, which must come first, in the
  /// same order in both triangles.
  static PairFault faultOf(const Corners& a, const Corners& b, int shared) {
    switch (shared) {
      case 0:
        return meetApart(a, b) ? PairFault::cut : PairFault::none;
      case 1:
        return meetBesideCorner(a, b) ? PairFault::cut : PairFault::none;
      case 2:
        return lieUponEachOther(a, b) ? PairFault::folded : PairFault::none;
      default:
        return PairFault::none;
    }
  }

  static bool pierce(const Corners& a, const Corners& b) { return passesThrough(a, b) || passesThrough(b, a); }

 private:
  /// True if p lies in the triangle or on its border. p must lie in the triangle's plane; both are projected along
  /// `drop`.
  static bool inTriangle(int drop, const Corners& t, const Place& p) {
    const int turn = Signs::orientationAlong(drop, t[0], t[1], t[2]);
    for (size_t k = 0; k < 3; ++k)
      if (turn * Signs::orientationAlong(drop, t[k], t[(k + 1) % 3], p) < 0) return false;
    return true;
  }

  /// True if p lies between a and b, or on one of them. The three points must be collinear.
  static bool between(const Place& a, const Place& b, const Place& p) {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < std::min(a[axis], b[axis]) || p[axis] > std::max(a[axis], b[axis])) return false;
    return true;
  }

  static bool segmentsMeet(int drop, const Place& a, const Place& b, const Place& c, const Place& d) {
    const int c_side = Signs::orientationAlong(drop, a, b, c), d_side = Signs::orientationAlong(drop, a, b, d);
    const int a_side = Signs::orientationAlong(drop, c, d, a), b_side = Signs::orientationAlong(drop, c, d, b);
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    return (c_side == 0 && between(a, b, c)) || (d_side == 0 && between(a, b, d)) ||
           (a_side == 0 && between(c, d, a)) || (b_side == 0 && between(c, d, b));
  }

  /// True if the segment meets the triangle. from_side, to_side: the results of orientation() for the ends of the
  /// segment and the triangle's plane.
  static bool segmentMeets(const Place& from, const Place& to, int from_side, int to_side, const Corners& t, int drop) {
    if (from_side * to_side > 0) return false;
    if (from_side == 0 && to_side == 0) {
      if (inTriangle(drop, t, from) || inTriangle(drop, t, to)) return true;
      for (size_t k = 0; k < 3; ++k)
        if (segmentsMeet(drop, from, to, t[k], t[(k + 1) % 3])) return true;
      return false;
    }
    int seen = 0;
    for (size_t k = 0; k < 3; ++k) {
      const int side = Signs::orientation(from, to, t[k], t[(k + 1) % 3]);
      if (side * seen < 0) return false;
      if (side != 0) seen = side;
    }
    return true;
  }

  static std::array<int, 3> sidesOf(const Corners& plane, const Corners& t) {
    std::array<int, 3> sides{};
    for (size_t k = 0; k < 3; ++k) sides[k] = Signs::orientation(plane[0], plane[1], plane[2], t[k]);
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

  /// For coplanar triangles: true if the line through an edge of `t` separates them, that is, all corners of `other`,
  /// except a common first corner, lie strictly beyond this line. This quick test suffices for most adjacent triangles
  /// on flat ground.
  static bool liesBeyond(int drop, const Corners& t, const Corners& other, size_t shared) {
    const int turn = Signs::orientationAlong(drop, t[0], t[1], t[2]);
    for (size_t k = 0; k < 3; ++k) {
      // If the triangles share their first corner, only an edge through that corner can separate them: skip the
      // opposite edge.
      if (shared == 1 && k == 1) continue;
      bool beyond = true;
      for (size_t i = shared; i < 3 && beyond; ++i)
        beyond = turn * Signs::orientationAlong(drop, t[k], t[(k + 1) % 3], other[i]) < 0;
      if (beyond) return true;
    }
    return false;
  }

  /// Returns the corner that is alone on its side of a plane; nullopt if a corner lies in the plane. sides: the side of
  /// each corner (1, 0 or -1).
  static std::optional<size_t> loneCorner(const std::array<int, 3>& sides) {
    if (sides[0] == 0 || sides[1] == 0 || sides[2] == 0) return std::nullopt;
    return sides[0] == sides[1] ? 2 : sides[0] == sides[2] ? 1 : 0;
  }

  /// True if two triangles intersect. Precondition: each triangle crosses the plane of the other and has no corner in
  /// it. So each triangle has a lone corner: the only corner on its side of the other triangle's plane. Both triangles
  /// meet the line common to both planes, each in the interval between its two edges at its lone corner. Whether the
  /// intervals overlap follows from the order of their ends; the order of two ends is the sign of one orientation
  /// (Guigue and Devillers, Fast and Robust Triangle-Triangle Overlap Test Using Orientation Predicates, 2003).
  static bool crossingMeet(const Corners& a, size_t a_lone, int a_side, const Corners& b, size_t b_lone, int b_side) {
    // Reorders the corners of both triangles, so that each lone corner comes first and lies in front of the plane of
    // the other triangle.
    const Corners p = {a[a_lone], a[(a_lone + (b_side > 0 ? 2 : 1)) % 3], a[(a_lone + (b_side > 0 ? 1 : 2)) % 3]};
    const Corners q = {b[b_lone], b[(b_lone + (a_side > 0 ? 2 : 1)) % 3], b[(b_lone + (a_side > 0 ? 1 : 2)) % 3]};
    return Signs::orientation(p[0], p[1], q[0], q[1]) >= 0 && Signs::orientation(p[0], p[2], q[0], q[2]) <= 0;
  }

  static bool meetApart(const Corners& a, const Corners& b) {
    const std::array<int, 3> b_sides = sidesOf(a, b);
    if (allOnOneSide(b_sides)) return false;
    const std::array<int, 3> a_sides = sidesOf(b, a);
    if (allOnOneSide(a_sides)) return false;
    const std::optional<size_t> a_lone = loneCorner(a_sides), b_lone = loneCorner(b_sides);
    if (a_lone && b_lone) return crossingMeet(a, *a_lone, a_sides[*a_lone], b, *b_lone, b_sides[*b_lone]);
    const int a_drop = Signs::seenAlong(a), b_drop = Signs::seenAlong(b);
    if (a_drop < 0 || b_drop < 0) return false;
    if (b_sides == std::array<int, 3>{} && (liesBeyond(a_drop, a, b, 0) || liesBeyond(a_drop, b, a, 0))) return false;
    return anyEdgeMeets(a, a_sides, b, b_drop) || anyEdgeMeets(b, b_sides, a, a_drop);
  }

  /// True if two triangles that share their first corner meet elsewhere. They do exactly if the edge of one triangle
  /// opposite to the common corner meets the other triangle: if they meet at any other point, they also meet along the
  /// segment from the common corner through that point, which ends at such an edge.
  static bool meetBesideCorner(const Corners& a, const Corners& b) {
    const int b1 = Signs::orientation(a[0], a[1], a[2], b[1]), b2 = Signs::orientation(a[0], a[1], a[2], b[2]);
    if (b1 * b2 > 0) return false;
    const int a1 = Signs::orientation(b[0], b[1], b[2], a[1]), a2 = Signs::orientation(b[0], b[1], b[2], a[2]);
    if (a1 * a2 > 0) return false;
    const int a_drop = Signs::seenAlong(a), b_drop = Signs::seenAlong(b);
    if (a_drop < 0 || b_drop < 0) return false;
    if (b1 == 0 && b2 == 0 && (liesBeyond(a_drop, a, b, 1) || liesBeyond(a_drop, b, a, 1))) return false;
    return segmentMeets(b[1], b[2], b1, b2, a, a_drop) || segmentMeets(a[1], a[2], a1, a2, b, b_drop);
  }

  /// True if two triangles that share their first two corners overlap in one plane.
  static bool lieUponEachOther(const Corners& a, const Corners& b) {
    if (Signs::orientation(a[0], a[1], a[2], b[2]) != 0) return false;
    const int drop = Signs::seenAlong(a);
    if (drop < 0 || Signs::seenAlong(b) < 0) return false;
    return Signs::orientationAlong(drop, a[0], a[1], a[2]) == Signs::orientationAlong(drop, a[0], a[1], b[2]);
  }

  static bool passesThrough(const Corners& edges, const Corners& wall) {
    const std::array<int, 3> sides = sidesOf(wall, edges);
    for (size_t k = 0; k < 3; ++k) {
      const size_t next = (k + 1) % 3;
      if (sides[k] * sides[next] >= 0) continue;
      const int turn = Signs::orientation(edges[k], edges[next], wall[0], wall[1]);
      if (turn != 0 && turn == Signs::orientation(edges[k], edges[next], wall[1], wall[2]) &&
          turn == Signs::orientation(edges[k], edges[next], wall[2], wall[0]))
        return true;
    }
    return false;
  }
};

/// Moves the common corners to the front of both triangles, in the same order; returns their number.
template <class Corner>
int sharedFirst(std::array<Corner, 3>& a, std::array<Corner, 3>& b) {
  size_t shared = 0;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = shared; j < 3; ++j) {
      if (!(a[i] == b[j])) continue;
      std::swap(b[shared], b[j]);
      std::swap(a[shared], a[i]);
      ++shared;
      break;
    }
  }
  return static_cast<int>(shared);
}

}  // namespace sgm
