#pragma once
// Triangles with materials by name: what a file holds, in metres.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "asset/point.h"

namespace sgm::asset {

inline constexpr uint32_t kNoMaterial = 0xFFFFFFFFu;

/// What the corners of triangles have beside their place, in one of two forms: one value a point, or, where corners
/// that share a point differ (a crease, a seam of a chart), values of their own that the corners number. The points
/// stay what the file holds, so that the topology does.
template <class Value>
struct CornerValues {
  std::vector<Value> values;  ///< empty: the file has none
  /// Of each triangle, into values. Empty: values[p] is that of points[p].
  std::vector<std::array<uint32_t, 3>> corners;

  bool empty() const { return values.empty(); }
};

using Normal = std::array<float, 3>;              ///< of length one, or zero where the file gives none
using TextureCoordinates = std::array<float, 2>;  ///< the second grows upward

struct TriangleMesh {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<uint32_t> materials;                 ///< of each triangle, into material_names, or kNoMaterial
  std::vector<std::string> material_names;
  CornerValues<Normal> normals;
  CornerValues<TextureCoordinates> coordinates;
  Point origin;                    ///< where the points count from in their world, where that is known; metres
  bool in_metres = false;          ///< whether the file's format fixes the unit
  std::vector<std::string> notes;  ///< sentences about parts of the file that are left out, or read in spite of faults

  /// Of corner k of a triangle, where there are any.
  const Normal& normalAt(size_t triangle, size_t k) const { return at(normals, triangle, k); }
  const TextureCoordinates& coordinatesAt(size_t triangle, size_t k) const { return at(coordinates, triangle, k); }

 private:
  template <class Value>
  const Value& at(const CornerValues<Value>& of, size_t triangle, size_t k) const {
    return of.values[of.corners.empty() ? triangles[triangle][k] : of.corners[triangle][k]];
  }
};

/// A direction from a file, of any length; zero where it is too long to be measured.
inline Normal unitNormal(double x, double y, double z) {
  const double size = length({x, y, z});
  if (!(size > 0 && size < std::numeric_limits<double>::infinity())) return {};
  const Point n = (1 / size) * Point{x, y, z};
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

}  // namespace sgm::asset
