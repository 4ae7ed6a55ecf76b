#pragma once
// A small version of any mesh, for a preview on a page.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "asset/triangle_mesh.h"

namespace sgm::cli {

inline constexpr size_t kMostPreviewTriangles = 60'000;

struct Preview {
  asset::Point origin;                          ///< in the mesh's world; positions are relative to it
  std::vector<std::array<float, 3>> positions;  ///< finite, and each is used
  std::vector<uint32_t> indices;                ///< of triangles, at most kMostPreviewTriangles unless this cannot be
                                                ///< reached
  std::array<float, 3> low{}, high{};           ///< of the positions
};

/// Of the triangles with finite corners. Empty if there are none.
Preview previewOf(const asset::TriangleMesh& mesh);

/// "SGMPREV1", uint32 points, uint32 triangles, the positions, the indices; little-endian.
std::string bytesOf(const Preview& preview);

}  // namespace sgm::cli
