#pragma once
// Whether the edges of a polygon cross each other.

#include <span>

#include "asset/point.h"

namespace sgm::asset {

/// Of a polygon in the plane across the axis `drop` (0..2): whether two edges cross, or a corner on an edge leads from
/// one of its sides to the other. Corners and edges that touch, or lie on each other, do not cross. A sweep along the
/// plane (Shamos and Hoey, "Geometric Intersection Problems", FOCS 1976): n log n steps, by exact signs.
bool crossesItself(std::span<const Point> polygon, int drop);

}  // namespace sgm::asset
