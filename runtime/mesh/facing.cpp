#include "mesh/facing.h"

namespace sgm {
namespace {

/// Tolerance of the test whether a triangle faces inward: slivers may do so slightly, because their corners are
/// rounded. The test computes the dot product of the triangle's area vector, times two, and the sum of the normals at
/// its corners. The triangle faces inward if this product is less than -kFold times the square of a cell's edge.
constexpr double kFold = 0.02;

}  // namespace

bool facesOut(const LoopTriangles& triangles, const Creases& creases) {
  double all = 0;
  for (const NamedTriangle& triangle : triangles.all()) {
    std::array<Vector3, 3> at;
    Vector3 out{};
    for (size_t k = 0; k < 3; ++k) {
      for (size_t axis = 0; axis < 3; ++axis) at[k][axis] = triangle.at[k][static_cast<int>(axis)];
      if (triangle.name[k] >= kFaceVertices) continue;
      const Vector3& normal = creases.tangent(triangle.name[k]).normal;
      for (size_t axis = 0; axis < 3; ++axis) out[axis] += normal[axis];
    }
    const double outward = dot(cross(minus(at[1], at[0]), minus(at[2], at[0])), out);
    if (outward < -kFold * kSubcell * kSubcell) return false;
    all += outward;
  }
  return all > 0;
}

}  // namespace sgm
