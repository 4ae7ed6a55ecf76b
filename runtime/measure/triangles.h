#pragma once
// A borrowed triangle mesh, the input of every measure in this folder.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "asset/point.h"

namespace sgm::measure {

using asset::Point;
using Triangle = std::array<uint32_t, 3>;  ///< counter-clockwise seen from outside

/// Lengths are in any one unit of the caller: areas are in its square, volumes in its cube. Precondition: every index
/// is below points.size(). Only measureMesh() accepts any coordinates, including infinity and NaN: all other functions
/// require that none is beyond kFarthest.
struct Triangles {
  std::span<const Point> points;
  std::span<const Triangle> triangles;
  /// Memory for data that grows with the mesh, including results; used from any thread; outlives them.
  std::pmr::memory_resource* memory = std::pmr::new_delete_resource();
};

/// Beyond it, products of coordinates exceed the range of a double, and coordinates that of a float.
inline constexpr double kFarthest = 1e37;

/// Triangles per job. Sums are computed per block and added in order, so that their last bit does not depend on the
/// number of threads.
inline constexpr size_t kBlock = 4096;

}  // namespace sgm::measure
