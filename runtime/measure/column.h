#pragma once
// Which triangles lie over or under a place, along z: what "inside" is counted by.

#include <array>

#include "measure/triangles.h"

namespace sgm::measure {

/// 1 where the triangle covers (x, y) seen along z and faces up, -1 where it faces down, 0 where it does not cover it.
/// Of triangles around a common edge or corner those that go round the same way share the places on it out, so that a
/// closed surface is crossed as often upward as downward, exactly.
int turnOver(const std::array<Point, 3>& t, double x, double y);

}  // namespace sgm::measure
