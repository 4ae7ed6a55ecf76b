#pragma once
// Finds the triangles above or below a point along z, to decide whether the point is inside a closed surface.

#include <array>

#include "measure/triangles.h"

namespace sgm::measure {

/// Same as sgm::turnOver (mesh/column.h), for doubles.
int turnOver(const std::array<Point, 3>& t, double x, double y);

}  // namespace sgm::measure
