#pragma once
// Any triangle mesh, borrowed: what every measure of this folder reads.

#include <array>
#include <cstdint>
#include <span>

#include "asset/point.h"

namespace sgm::measure {

using asset::Point;
using Triangle = std::array<uint32_t, 3>;  ///< counter-clockwise seen from outside

/// Lengths are in one unit, which is the caller's: areas come in its square, volumes in its cube.
/// Contract: every index is below points.size(). Coordinates may be anything, also infinite or NaN.
struct Triangles {
  std::span<const Point> points;
  std::span<const Triangle> triangles;
};

/// Triangles that one job takes at a time. Sums are made block by block and these added in order, so that their last
/// bit does not depend on the number of threads.
inline constexpr size_t kBlock = 4096;

}  // namespace sgm::measure
