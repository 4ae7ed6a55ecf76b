#include "metrics/measure.h"

#include <cmath>
#include <utility>
#include <vector>

namespace sgm {
namespace {

/// Union-find with path halving.
uint32_t rootOf(std::vector<uint32_t>& parent, uint32_t v) {
  while (parent[v] != v) {
    parent[v] = parent[parent[v]];
    v = parent[v];
  }
  return v;
}

}  // namespace

Measures measure(const WorldMesh& mesh) {
  Measures result;
  std::vector<uint32_t> parent(mesh.positions.size());
  for (uint32_t v = 0; v < parent.size(); ++v) parent[v] = v;
  std::vector<bool> used(mesh.positions.size(), false);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const uint32_t* t = mesh.indices.data() + i;
    const std::array<double, 3>&a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    result.area += 0.5 * std::sqrt(x * x + y * y + z * z);
    for (int k = 0; k < 3; ++k) used[t[k]] = true;
    const uint32_t root = rootOf(parent, t[0]);
    parent[rootOf(parent, t[1])] = root;
    parent[rootOf(parent, t[2])] = root;
  }
  for (uint32_t v = 0; v < parent.size(); ++v) result.objects += used[v] && parent[v] == v ? 1u : 0u;
  return result;
}

double cubeVolume(uint64_t samples_inside, int32_t cell_units) {
  const double edge = static_cast<double>(cell_units) / kUnitsPerMetre;
  return static_cast<double>(samples_inside) * (edge * edge * edge);
}

}  // namespace sgm
