#pragma once
// Simplifies a mesh of any size for a preview on a web page.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "asset/triangle_mesh.h"

namespace sgm::cli {

inline constexpr size_t kMaxPreviewTriangles = 60'000;

struct Preview {
  asset::Point origin;                          ///< point of the mesh to which `positions` are relative
  std::vector<std::array<float, 3>> positions;  ///< finite vertex positions, each used by a triangle
  /// three vertex indices per triangle; at most kMaxPreviewTriangles triangles
  std::vector<uint32_t> indices;
  std::array<float, 3> low{}, high{};  ///< minimum and maximum corner of the bounding box of `positions`
};

/// A simplified mesh of the triangles with finite corners. Empty if there are none.
Preview previewOf(const asset::TriangleMesh& mesh);

/// Serializes a preview: "SGMPREV1", uint32 number of points, uint32 number of triangles, positions, indices;
/// little-endian.
std::string bytesOf(const Preview& preview);

}  // namespace sgm::cli
