#include "region/topology.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "mesh/check.h"
#include "region/measure.h"

namespace sgm {
namespace {

/// Returns the mask of the region's outer planes that contain the vertex: bit 2 * axis + side.
uint32_t bordersOf(const VertexKey& key, const IntBox& extent) {
  uint32_t planes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (key.axis == axis) continue;  // the vertex lies strictly between two samples on this axis
    // A feature vertex in a face of a cell can lie only in an outer plane that is parallel to the face; a feature
    // vertex inside a cell lies in no plane.
    if (key.axis >= kFaceVertex && key.axis != kFaceVertex + axis) continue;
    if (key.corner[axis] == extent.lo[axis]) planes |= 1u << 2 * axis;
    if (key.corner[axis] == extent.hi[axis]) planes |= 2u << 2 * axis;
  }
  return planes;
}

/// Returns the number of edges that belong to only one triangle and lie in one of the region's outer planes.
size_t openBorderEdges(const WorldMesh& mesh, const IntBox& extent) {
  std::vector<uint8_t> planes(mesh.keys.size());
  for (size_t v = 0; v < planes.size(); ++v) planes[v] = static_cast<uint8_t>(bordersOf(mesh.keys[v], extent));
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = mesh.indices[i + k], b = mesh.indices[i + (k + 1) % 3];
      if ((planes[a] & planes[b]) != 0) edges.push_back(std::minmax(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  size_t open = 0;
  for (size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    open += end - i == 1;
  }
  return open;
}

}  // namespace

Topology topologyOf(const WorldMesh& mesh, const IntBox& extent) {
  const MeshReport report = checkTriangles(mesh.indices, mesh.positions.size());
  Topology result;
  if (!report.manifold()) {
    result.leak = "the surface is not manifold: " + describe(report);
  } else if (const size_t inside = report.open_edges - openBorderEdges(mesh, extent); inside > 0) {
    result.leak = std::to_string(inside) + " open edges away from the region's border";
  }
  result.watertight = result.leak.empty();
  if (!result.watertight) {
    result.why = result.leak;
  } else if (report.open_edges > 0) {
    result.why = "the region's border cuts the surface";
  } else {
    // V - E + F = 2 (shells - genus). A closed surface has 3 F = 2 E, so E - F = F / 2. V: vertices, E: edges, F:
    // triangles.
    const auto euler = static_cast<int64_t>(report.vertices) - static_cast<int64_t>(report.triangles / 2);
    result.genus = static_cast<uint64_t>(static_cast<int64_t>(measuresOf(mesh).objects) - euler / 2);
  }
  return result;
}

}  // namespace sgm
