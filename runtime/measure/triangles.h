#pragma once
// Any triangle mesh, borrowed: what every measure of this folder reads.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "asset/point.h"

namespace sgm::measure {

using asset::Point;
using Triangle = std::array<uint32_t, 3>;  ///< counter-clockwise seen from outside

/// Lengths are in one unit, which is the caller's: areas come in its square, volumes in its cube.
/// Contract: every index is below points.size(). Coordinates may be anything, also infinite or NaN, for measureMesh()
/// alone: all else asks that none is beyond kFarthest.
struct Triangles {
  std::span<const Point> points;
  std::span<const Triangle> triangles;
  /// Where work on it keeps what grows with it, results too, from any thread; outlives them.
  std::pmr::memory_resource* memory = std::pmr::new_delete_resource();
};

/// Beyond it products of coordinates leave the range of a double, and coordinates that of a float.
inline constexpr double kFarthest = 1e37;

/// Triangles that one job takes at a time. Sums are made block by block and these added in order, so that their last
/// bit does not depend on the number of threads.
inline constexpr size_t kBlock = 4096;

}  // namespace sgm::measure
