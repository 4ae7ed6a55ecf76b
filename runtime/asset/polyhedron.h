#pragma once
// A closed mesh as plane faces: what `fit` stretches.

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

/// Of an asset with so long an edge: what lies nearer to each other is in one place.
constexpr double toleranceOf(double longest_edge) { return 2e-6 * longest_edge; }

/// Triangles in one plane that hang together and have one material.
struct Face {
  Plane plane;  ///< its normal looks out of the solid
  uint32_t material = kNoMaterial;
};

/// Every edge has as many triangles on one side as on the other. Parts of it may touch and overlap.
struct Polyhedron {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<uint32_t> face_of;  ///< of each triangle
  std::vector<Face> faces;
  Point low, high;  ///< its box

  double longestEdge() const;
  double tolerance() const { return toleranceOf(longestEdge()); }
  void findBox();
  /// Of its parts together; where they overlap, twice.
  double volume() const;
};

/// What to do about meshes of which makePolyhedron says that they are too large.
inline constexpr std::string_view kSimplifyAdvice = "simplify it in the modelling tool, or fit it in several parts";

/// Errors: bad_input (open, inside out, flat), limit (too many triangles or faces).
Result<Polyhedron> makePolyhedron(const TriangleMesh& mesh);

}  // namespace sgm::asset
