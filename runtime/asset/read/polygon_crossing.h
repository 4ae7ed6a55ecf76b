#pragma once
// Checks whether the edges of a polygon cross each other.

#include <span>

#include "asset/point.h"

namespace sgm::asset {

/// Projects a polygon along the axis `drop` (0..2). Returns true if two edges cross, or if the polygon passes through
/// an edge at one of its corners. Corners and edges that only touch or overlap do not count. A plane sweep (Shamos and
/// Hoey, "Geometric Intersection Problems", FOCS 1976): n log n steps, with exact signs.
bool crossesItself(std::span<const Point> polygon, int drop);

}  // namespace sgm::asset
