#pragma once
// Simplifies any mesh to a small one, for a preview on a web page.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "asset/triangle_mesh.h"

namespace sgm::cli {

inline constexpr size_t kMaxPreviewTriangles = 60'000;

struct Preview {
  asset::Point origin;                          ///< in the coordinates of the mesh; positions are relative to it
  std::vector<std::array<float, 3>> positions;  ///< finite; triangles use every position
  /// Three for each triangle; at most kMaxPreviewTriangles triangles, unless the mesh cannot be simplified so far.
  std::vector<uint32_t> indices;
  std::array<float, 3> low{}, high{};  ///< bounds of the positions
};

/// The preview of the triangles with finite corners. Empty if there are none.
Preview previewOf(const asset::TriangleMesh& mesh);

/// The preview as bytes: "SGMPREV1", uint32 number of points, uint32 number of triangles, positions, indices;
/// little-endian.
std::string bytesOf(const Preview& preview);

}  // namespace sgm::cli
