#pragma once
// A closed mesh with planar faces, which `fit` resizes.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "asset/point.h"
#include "asset/triangle_mesh.h"
#include "base/result.h"

namespace sgm::asset {

inline constexpr size_t kMaxTriangles = 4096, kMaxFaces = 256;

/// Returns the tolerance in metres for an asset with this longest edge: points closer together count as one point.
constexpr double toleranceOf(double longest_edge) { return 2e-6 * longest_edge; }

/// A maximal set of connected, coplanar triangles of one material.
struct Face {
  Plane plane;  ///< plane of the face; its normal points out of the solid
  uint32_t material = kNoMaterial;
};

/// A closed mesh: along every edge, as many triangles run in one direction as in the other. Parts of the mesh may touch
/// and overlap.
struct Polyhedron {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<uint32_t> face_of;  ///< for each triangle: index of its face
  std::vector<Face> faces;
  Point low, high;  ///< corners of the bounding box

  double longestEdge() const;
  double tolerance() const { return toleranceOf(longestEdge()); }
  void findBox();
  /// Returns the sum of the volumes of the mesh's parts in cubic metres; overlaps count several times.
  double volume() const;
};

/// The advice in error messages about meshes that are too large for makePolyhedron.
inline constexpr std::string_view kSimplifyAdvice = "simplify it in the modelling tool, or fit it in several parts";

/// Makes a polyhedron from a mesh. Errors: bad_input if the mesh is open, inside out or flat; limit if it has too many
/// triangles or faces.
Result<Polyhedron> makePolyhedron(const TriangleMesh& mesh);

}  // namespace sgm::asset
