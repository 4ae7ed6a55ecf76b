#include "region/measure.h"

#include <vector>

#include "measure/area_volume.h"
#include "measure/union_find.h"
#include "measure/world_triangles.h"

namespace sgm {

Measures measuresOf(const WorldMesh& mesh, Int3 about) {
  Measures result;
  // The vector from `about` to the origin of the mesh's positions, in metres.
  measure::Point from;
  for (int axis = 0; axis < 3; ++axis)
    from[axis] = static_cast<double>(int64_t{mesh.origin[axis]} - about[axis]) / kUnitsPerMetre;
  measure::UnionFind objects(mesh.positions.size(), std::pmr::new_delete_resource());
  std::vector<bool> used(mesh.positions.size(), false);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const uint32_t* t = mesh.indices.data() + i;
    const auto corner = [&](size_t k) { return measure::pointOf(mesh.positions[t[k]]); };
    const measure::Point cross = measure::crossOf(corner(0), corner(1), corner(2));
    result.area += 0.5 * length(cross);
    result.flux += dot(corner(0) + from, cross) / 6;
    for (size_t k = 0; k < 3; ++k) used[t[k]] = true;
    objects.join(t[0], t[1]);
    objects.join(t[0], t[2]);
  }
  for (uint32_t v = 0; v < used.size(); ++v) result.objects += used[v] && objects.rootOf(v) == v;
  return result;
}

double cubeVolume(uint64_t samples_inside, int32_t cell_units) {
  const double edge = static_cast<double>(cell_units) / kUnitsPerMetre;
  return static_cast<double>(samples_inside) * (edge * edge * edge);
}

}  // namespace sgm
