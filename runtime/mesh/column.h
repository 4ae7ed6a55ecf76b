#pragma once
// Finds the triangles above or below a point along z, to decide whether the point is inside a closed surface.

#include <array>
#include <cstddef>
#include <utility>

namespace sgm {

/// Returns 1 if the triangle covers the (x, y) of the point seen along z and faces up, -1 if it faces down, 0 if it
/// does not cover the point. If several triangles with the same orientation share the edge or corner below the point,
/// exactly one of them covers it, so that a closed surface has exactly as many upward as downward crossings. Signs:
/// provides orientationAlong, as IntegerSigns does (mesh/triangle_faults.h).
template <class Signs>
int turnOver(const std::array<typename Signs::Place, 3>& t, const typename Signs::Place& place) {
  const int round = Signs::orientationAlong(2, t[0], t[1], t[2]);
  for (size_t k = 0; round != 0 && k < 3; ++k) {
    typename Signs::Place a = t[k], b = t[(k + 1) % 3];
    if (round < 0) std::swap(a, b);
    const int side = Signs::orientationAlong(2, a, b, place);
    // A point exactly on an edge is covered only by the triangle on one fixed side of the edge.
    const bool owns = b.y < a.y || (b.y == a.y && b.x > a.x);
    if (side < 0 || (side == 0 && !owns)) return 0;
  }
  return round;
}

}  // namespace sgm
