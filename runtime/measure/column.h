#pragma once
// Which triangles lie over or under a place, along z: what "inside" is counted by.

#include <array>

#include "measure/triangles.h"

namespace sgm::measure {

/// As sgm::turnOver (mesh/column.h), of doubles.
int turnOver(const std::array<Point, 3>& t, double x, double y);

}  // namespace sgm::measure
