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

/// A triangle mesh. Lengths are in any unit that the caller chooses; areas are in its square, volumes in its cube.
/// Precondition: every index is below points.size(). measureMesh() accepts any coordinates, including infinity and NaN;
/// all other functions require that none exceeds kFarthest.
struct Triangles {
  std::span<const Point> points;
  std::span<const Triangle> triangles;
  /// Allocates the results and all other data that grows with the mesh. Used from any thread; must outlive the results.
  std::pmr::memory_resource* memory = std::pmr::new_delete_resource();
};

/// The maximum magnitude of coordinates. Such coordinates fit into a float (Bvh::Box), and products of several of them
/// into a double.
inline constexpr double kFarthest = 1e37;

/// The number of triangles per job. Sums are computed per block and added in the order of blocks, so that their last
/// bit does not depend on the number of threads.
inline constexpr size_t kBlock = 4096;

}  // namespace sgm::measure
