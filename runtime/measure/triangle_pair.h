#pragma once
// Do two triangles of a mesh meet where they should not? Exactly.

#include "measure/triangles.h"

namespace sgm::measure {

/// Whether they have a point in common beside the corners and edges that they share by number:
///  - with no corner in common: any point, touching included;
///  - with one: any other point;
///  - with two: where they lie in one plane on the same side of the common edge (a fold of 180 degrees).
/// With three they are duplicates, and false. Triangles without area meet nothing.
bool meetWrongly(std::span<const Point> points, const Triangle& a, const Triangle& b);

/// Whether the corners lie on a line (or in a point).
bool isFlat(std::span<const Point> points, const Triangle& t);

}  // namespace sgm::measure
