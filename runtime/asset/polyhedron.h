#pragma once
// A closed mesh with planar faces, which `fit` stretches.

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

/// The tolerance of an asset whose longest edge has this length: points closer to each other count as one point.
constexpr double toleranceOf(double longest_edge) { return 2e-6 * longest_edge; }

/// Connected coplanar triangles of one material.
struct Face {
  Plane plane;  ///< its normal points out of the solid
  uint32_t material = kNoMaterial;
};

/// A mesh in which every edge has equally many triangles on both sides. Parts of it may touch and overlap.
struct Polyhedron {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<uint32_t> face_of;  ///< index of each triangle's face
  std::vector<Face> faces;
  Point low, high;  ///< corners of the bounding box

  double longestEdge() const;
  double tolerance() const { return toleranceOf(longestEdge()); }
  void findBox();
  /// The sum of the volumes of its parts; overlaps count twice.
  double volume() const;
};

/// The advice in errors about meshes that are too large for makePolyhedron.
inline constexpr std::string_view kSimplifyAdvice = "simplify it in the modelling tool, or fit it in several parts";

/// Makes a polyhedron of a mesh. Errors: bad_input (the mesh is open, inside out or flat), limit (too many triangles or
/// faces).
Result<Polyhedron> makePolyhedron(const TriangleMesh& mesh);

}  // namespace sgm::asset
