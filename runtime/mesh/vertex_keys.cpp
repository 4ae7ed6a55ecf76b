#include "mesh/vertex_keys.h"

#include <array>

#include "mesh/feature_kind.h"

namespace sgm {

namespace {

constexpr int kCoarseStep = 2 * kSubcell;

/// A vertex lies between two neighbouring points of a grid with the spacing `step`. Returns the axis along which they
/// are neighbours.
uint8_t axisOf(const std::array<int, 3>& at, int step) { return at[0] % step != 0 ? 0 : at[1] % step != 0 ? 1 : 2; }

}  // namespace

void deriveKeys(const ChunkGrid& grid, int number, Neighbourhood coarser, MeshPart& part) {
  SeamFans fans{};
  size_t u = 0, v = 0;
  if (number > 0) {
    const auto face = static_cast<Face>(number - 1);
    fans = seamFans(face, coarser);
    u = static_cast<size_t>((faceAxis(face) + 1) % 3);
    v = static_cast<size_t>((faceAxis(face) + 2) % 3);
  }
  const auto border = [](int at) { return at == 0 ? size_t{0} : at == kChunkCells * kSubcell ? size_t{2} : size_t{1}; };
  part.keys.resize(part.vertices.size());
  for (size_t i = 0; i < part.vertices.size(); ++i) {
    const Vertex& vertex = part.vertices[i];
    if (isFeature(vertex.kind)) {
      part.keys[i] = featureKey(grid, vertex);
      continue;
    }
    const std::array<int, 3> at{vertex.x, vertex.y, vertex.z};
    const int step = vertex.kind == kOwnEdge ? kSubcell : kCoarseStep;
    VertexKey key;
    key.level = static_cast<uint8_t>(grid.level + (vertex.kind == kCoarserEdge ? 1 : 0));
    key.axis = vertex.kind == kLateralEdge ? kLateral : axisOf(at, step);
    if (vertex.kind == kLateralEdge) key.fan = fans[border(at[v])][border(at[u])];
    for (int axis = 0; axis < 3; ++axis) {
      key.corner[axis] = grid.origin[axis] + at[static_cast<size_t>(axis)] / step * (step / kSubcell) * grid.cell;
    }
    part.keys[i] = key;
  }
}

}  // namespace sgm
