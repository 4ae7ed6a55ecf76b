#pragma once
// Triangles with named materials: the content of a file, in metres.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "asset/point.h"

namespace sgm::asset {

inline constexpr uint32_t kNoMaterial = 0xFFFFFFFFu;

/// The attributes of triangle corners, in one of two forms: one value per point, or, if corners that share a point
/// differ (a crease, a seam of a chart), separate values that the corners index. The points stay those of the file, and
/// so does the topology.
template <class Value>
struct CornerValues {
  std::vector<Value> values;  ///< empty: the file has none
  /// For each triangle, indices into values. Empty: values[p] belongs to points[p].
  std::vector<std::array<uint32_t, 3>> corners;

  bool empty() const { return values.empty(); }
};

using Normal = std::array<float, 3>;              ///< of length one, or zero if the file gives none
using TextureCoordinates = std::array<float, 2>;  ///< the second grows upward

struct TriangleMesh {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<uint32_t> materials;                 ///< one per triangle, into material_names, or kNoMaterial
  std::vector<std::string> material_names;
  CornerValues<Normal> normals;
  CornerValues<TextureCoordinates> coordinates;
  Point origin;                    ///< position of the points' origin in their world if known; metres
  bool in_metres = false;          ///< true if the file's format defines the unit
  std::vector<std::string> notes;  ///< sentences about parts of the file left out, or read despite errors

  /// The value of corner k of a triangle; the mesh must have some.
  const Normal& normalAt(size_t triangle, size_t k) const { return at(normals, triangle, k); }
  const TextureCoordinates& coordinatesAt(size_t triangle, size_t k) const { return at(coordinates, triangle, k); }

 private:
  template <class Value>
  const Value& at(const CornerValues<Value>& of, size_t triangle, size_t k) const {
    return of.values[of.corners.empty() ? triangles[triangle][k] : of.corners[triangle][k]];
  }
};

/// Normalises a direction from a file; zero if it is too long to be measured.
inline Normal unitNormal(double x, double y, double z) {
  const double size = length({x, y, z});
  if (!(size > 0 && size < std::numeric_limits<double>::infinity())) return {};
  const Point n = (1 / size) * Point{x, y, z};
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

}  // namespace sgm::asset
