#include "measure/world_triangles.h"

namespace sgm::measure {

asset::TriangleMesh trianglesOf(const WorldMesh& mesh) {
  asset::TriangleMesh out;
  for (int axis = 0; axis < 3; ++axis) out.origin[axis] = metres(mesh.origin[axis]);
  out.points.reserve(mesh.positions.size());
  for (const std::array<double, 3>& p : mesh.positions) out.points.push_back(pointOf(p));
  out.triangles.reserve(mesh.indices.size() / 3);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    out.triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
  }
  return out;
}

}  // namespace sgm::measure
