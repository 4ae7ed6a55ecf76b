#pragma once
// The affine transform of a node of a glTF file.

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "asset/read/mesh_limits.h"
#include "asset/triangle_mesh.h"
#include "base/json_reader.h"

namespace sgm::asset {

/// The affine transform p -> columns * p + origin.
struct GlbTransform {
  std::array<Point, 3> columns{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  Point origin;

  Point turned(Point p) const { return p.x * columns[0] + p.y * columns[1] + p.z * columns[2]; }
  Point operator()(Point p) const { return turned(p) + origin; }
  GlbTransform after(const GlbTransform& inner) const {
    return {{turned(inner.columns[0]), turned(inner.columns[1]), turned(inner.columns[2])}, (*this)(inner.origin)};
  }
  bool mirrors() const { return dot(cross(columns[0], columns[1]), columns[2]) < 0; }
  bool rests() const { return columns == GlbTransform{}.columns && origin == Point{}; }
  /// Returns the matrix that transforms normals, up to a positive factor: the inverse transpose, computed as the
  /// cofactors times the sign of the determinant. The matrix is 0 if the transform maps space to a line.
  std::array<Point, 3> forNormals() const {
    const double sign = mirrors() ? -1 : 1;
    return {sign * cross(columns[1], columns[2]), sign * cross(columns[2], columns[0]),
            sign * cross(columns[0], columns[1])};
  }
};

/// Makes a transform from a translation, a rotation (a quaternion x y z w of any length except 0) and a scale.
GlbTransform glbTransformOf(Point translation, const std::array<double, 4>& rotation, Point scale);
/// Makes a transform from a column-major 4 x 4 matrix; nullopt if the matrix is not affine.
std::optional<GlbTransform> glbTransformOf(const std::array<double, 16>& matrix);
/// Reads the transform of node `number`, from its matrix or from its translation, rotation and scale. Error: bad_input.
Result<GlbTransform> glbTransformOf(const JsonValue& node, size_t number);

/// Reads an array member with exactly N numbers. Returns false if the member is anything else. If the member is
/// missing, `out` stays unchanged and the result is true.
template <size_t N>
bool readNumbers(const JsonValue& of, std::string_view name, std::array<double, N>& out) {
  if (of.find(name) == nullptr) return true;
  const auto list = of.list(name);
  if (list.size() != N) return false;
  for (size_t i = 0; i < N; ++i) {
    if (list[i].kind != JsonValue::Kind::number || !(std::fabs(list[i].number) <= 1e9)) return false;
    out[i] = list[i].number;
  }
  return true;
}

}  // namespace sgm::asset
