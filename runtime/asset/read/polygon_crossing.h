#pragma once
// Checks whether the edges of a polygon cross each other.

#include <span>

#include "asset/point.h"

namespace sgm::asset {

/// Projects a polygon along the axis `drop` (0..2). Returns true if two edges cross, or if the polygon crosses one of
/// its edges at a corner. Corners and edges that only touch or overlap do not count. Uses a plane sweep (Shamos and
/// Hoey, "Geometric Intersection Problems", FOCS 1976) with exact signs; takes n log n steps.
bool crossesItself(std::span<const Point> polygon, int drop);

}  // namespace sgm::asset
