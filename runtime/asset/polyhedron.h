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

inline constexpr size_t kMostTriangles = 4096, kMostFaces = 256;

/// The tolerance of an asset with this longest edge: points closer than this coincide.
constexpr double toleranceOf(double longest_edge) { return 2e-6 * longest_edge; }

/// Connected coplanar triangles of one material.
struct Face {
  Plane plane;  ///< its normal looks out of the solid
  uint32_t material = kNoMaterial;
};

/// Every edge has equally many triangles on both sides. Parts may touch and overlap.
struct Polyhedron {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<uint32_t> face_of;  ///< for each triangle
  std::vector<Face> faces;
  Point low, high;  ///< its box

  double longestEdge() const;
  double tolerance() const { return toleranceOf(longestEdge()); }
  void findBox();
  /// The sum over its parts; overlaps count twice.
  double volume() const;
};

/// The remedy for meshes that makePolyhedron rejects as too large.
inline constexpr std::string_view kSimplifyAdvice = "simplify it in the modelling tool, or fit it in several parts";

/// Errors: bad_input (open, inside out, flat), limit (too many triangles or faces).
Result<Polyhedron> makePolyhedron(const TriangleMesh& mesh);

}  // namespace sgm::asset
