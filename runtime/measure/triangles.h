#pragma once
// A borrowed triangle mesh, the input of every measure in this folder.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "asset/point.h"

namespace sgm::measure {

using asset::Point;
using Triangle = std::array<uint32_t, 3>;  ///< indices of its corners, counter-clockwise seen from outside

/// Lengths are in any unit that the caller chooses; areas are in its square, volumes in its cube. Precondition: every
/// index is below points.size(). measureMesh() accepts any coordinates, including infinity and NaN; all other functions
/// require that none exceeds kFarthest.
struct Triangles {
  std::span<const Point> points;
  std::span<const Triangle> triangles;
  /// Used for results and all other data that grows with the mesh, from any thread; must outlive the results.
  std::pmr::memory_resource* memory = std::pmr::new_delete_resource();
};

/// The maximum magnitude of coordinates. Products of larger ones exceed the range of a double, and larger ones that of
/// a float.
inline constexpr double kFarthest = 1e37;

/// The number of triangles per job. Sums are computed per block and added in the order of blocks, so that their last
/// bit does not depend on the number of threads.
inline constexpr size_t kBlock = 4096;

}  // namespace sgm::measure
