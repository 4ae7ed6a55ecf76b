#pragma once
// A triangle mesh with named materials, in metres: the content of a mesh file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "asset/point.h"

namespace sgm::asset {

inline constexpr uint32_t kNoMaterial = 0xFFFFFFFFu;

/// An attribute of triangle corners (normal or texture coordinates) in one of two forms. Either there is one value per
/// point. Or, if corners that share a point have different values, at a crease or a texture seam, each corner refers to
/// its value by an index. In both forms the points and the topology stay those of the file.
template <class Value>
struct CornerValues {
  std::vector<Value> values;  ///< the values; empty if the file does not have this attribute
  /// For each triangle, three indices into values. If empty, there is one value per point: values[p] belongs to
  /// points[p].
  std::vector<std::array<uint32_t, 3>> corners;

  bool empty() const { return values.empty(); }
};

using Normal = std::array<float, 3>;              ///< a vector of length 1, or 0 if the file gives no normal
using TextureCoordinates = std::array<float, 2>;  ///< (u, v), where v grows upward

struct TriangleMesh {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> triangles;  ///< indices of three points per triangle, counter-clockwise seen
                                                   ///< from outside
  std::vector<uint32_t> materials;                 ///< for each triangle: index into material_names, or kNoMaterial
  std::vector<std::string> material_names;
  CornerValues<Normal> normals;
  CornerValues<TextureCoordinates> coordinates;
  /// world position, in metres, of the origin of the points in the world from which the mesh was exported; 0 if unknown
  Point origin;
  bool in_metres = false;  ///< true if the file's format defines the metre as its unit
  /// sentences for the user about parts of the file that were left out, or read despite errors
  std::vector<std::string> notes;

  /// Returns the normal at corner k (0..2) of a triangle. Precondition: the mesh has normals.
  const Normal& normalAt(size_t triangle, size_t k) const { return at(normals, triangle, k); }
  const TextureCoordinates& coordinatesAt(size_t triangle, size_t k) const { return at(coordinates, triangle, k); }

 private:
  template <class Value>
  const Value& at(const CornerValues<Value>& of, size_t triangle, size_t k) const {
    return of.values[of.corners.empty() ? triangles[triangle][k] : of.corners[triangle][k]];
  }
};

/// Normalises a direction from a file. Returns 0 if its length is 0 or overflows.
inline Normal unitNormal(double x, double y, double z) {
  const double size = length({x, y, z});
  if (!(size > 0 && size < std::numeric_limits<double>::infinity())) return {};
  const Point n = (1 / size) * Point{x, y, z};
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

}  // namespace sgm::asset
