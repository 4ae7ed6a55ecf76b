#pragma once
// Which triangles lie over or under a place, along z: the inside of a closed surface is counted by them.

#include <array>
#include <cstddef>
#include <utility>

namespace sgm {

/// 1 where the triangle covers (x, y) of the place seen along z and faces up, -1 where it faces down, 0 where it does
/// not cover it. Of triangles around a common edge or corner those that go round the same way share the places on it
/// out, so that a closed surface is crossed as often upward as downward, exactly. Signs: as IntegerSigns
/// (mesh/triangle_faults.h), of which orientationAlong is taken.
template <class Signs>
int turnOver(const std::array<typename Signs::Place, 3>& t, const typename Signs::Place& place) {
  const int round = Signs::orientationAlong(2, t[0], t[1], t[2]);
  for (size_t k = 0; round != 0 && k < 3; ++k) {
    typename Signs::Place a = t[k], b = t[(k + 1) % 3];
    if (round < 0) std::swap(a, b);
    const int side = Signs::orientationAlong(2, a, b, place);
    // A place on the edge belongs to the triangle on its one side.
    const bool owns = b.y < a.y || (b.y == a.y && b.x > a.x);
    if (side < 0 || (side == 0 && !owns)) return 0;
  }
  return round;
}

}  // namespace sgm
