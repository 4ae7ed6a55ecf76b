#pragma once
// A mesh for a look at it on a page: small, whatever the mesh is.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "asset/triangle_mesh.h"

namespace sgm::cli {

inline constexpr size_t kMostPreviewTriangles = 60'000;

struct Preview {
  asset::Point origin;                          ///< in the mesh's world; the positions count from it
  std::vector<std::array<float, 3>> positions;  ///< finite, and each is used
  std::vector<uint32_t> indices;                ///< of triangles, as few as may be
  std::array<float, 3> low{}, high{};           ///< of the positions
};

/// Of the triangles whose corners are numbers. Empty where there are none.
Preview previewOf(const asset::TriangleMesh& mesh);

/// "SGMPREV1", uint32 points, uint32 triangles, the positions, the indices; little-endian.
std::string bytesOf(const Preview& preview);

}  // namespace sgm::cli
