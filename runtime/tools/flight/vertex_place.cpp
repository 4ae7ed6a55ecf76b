#include "tools/flight/vertex_place.h"

#include <sgm/sgm.h>

#include <array>

#include "base/hash.h"

namespace sgm::cli {
namespace {

/// Returns the key of a feature vertex in a chunk's body (if seam is null) or in the seam `seam`. Returns nullopt if
/// the vertex cannot belong to the body or to this seam.
std::optional<VertexKey> featureKey(const ChunkGrid& grid, const VertexPlace& vertex, const SeamOf* seam) {
  const bool of_cell = (vertex.kind >> 14 & 1) != 0, coarser = (vertex.kind >> 13 & 1) != 0;
  if (seam == nullptr ? coarser : of_cell) return {};
  const int step = (coarser ? 2 : 1) * kSubcell;
  const int32_t cell = grid.cell * (coarser ? 2 : 1);
  VertexKey key;
  key.level = static_cast<uint8_t>(grid.level + (coarser ? 1 : 0));
  key.axis = static_cast<uint8_t>(of_cell ? 7 : 4 + (vertex.kind >> 6 & 3));
  key.fan = static_cast<uint8_t>(of_cell ? vertex.kind >> 6 & 15 : vertex.kind >> 8 & 15);
  const std::array<int, 3> at{vertex.x, vertex.y, vertex.z};
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t corner = floorDiv(at[static_cast<size_t>(axis)], step) - ((vertex.kind >> 2 * axis & 3) - 1);
    if (corner < 0 || corner * step > kChunkEdge) return {};
    key.corner[axis] = saturate(grid.origin[axis] + corner * cell);
  }
  if (!of_cell && key.axis == 7) return {};
  if (seam == nullptr) return key;
  const int axis = faceAxis(seam->face);
  const int64_t plane = grid.origin[axis] + (faceIsHigh(seam->face) ? int64_t{kChunkCells} * grid.cell : 0);
  if (key.axis != 4 + axis || key.corner[axis] != plane) return {};
  return key;
}

}  // namespace

bool isFeature(const VertexPlace& v) { return (v.kind & SGM_VERTEX_FEATURE) != 0; }

bool isInside(const VertexPlace& v) {
  const auto inner = [](int16_t at) { return at != 0 && at != kChunkEdge; };
  return !isFeature(v) && inner(v.x) && inner(v.y) && inner(v.z);
}

std::optional<VertexKey> vertexKey(const ChunkGrid& grid, const VertexPlace& vertex, const SeamOf* seam) {
  if (isFeature(vertex)) return featureKey(grid, vertex, seam);
  const std::array<int, 3> at{vertex.x, vertex.y, vertex.z};
  if (vertex.kind > SGM_VERTEX_LATERAL || (vertex.kind != SGM_VERTEX_OWN && seam == nullptr)) return {};
  const int step = vertex.kind == SGM_VERTEX_OWN ? kSubcell : 2 * kSubcell;
  VertexKey key;
  key.level = static_cast<uint8_t>(grid.level + (vertex.kind == SGM_VERTEX_COARSER ? 1 : 0));
  key.axis = kLateral;
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int local = at[static_cast<size_t>(axis)];
    if (local < 0 || local > kChunkEdge) return {};
    if (local % step != 0) {
      key.axis = static_cast<uint8_t>(axis);
      ++axes;
    }
    key.corner[axis] = saturate(grid.origin[axis] + int64_t{local / step * (step / kSubcell)} * grid.cell);
  }
  if (axes != (vertex.kind == SGM_VERTEX_LATERAL ? 0 : 1)) return {};
  if (seam == nullptr) return key;
  const auto axis = static_cast<size_t>(faceAxis(seam->face));
  if (at[axis] != (faceIsHigh(seam->face) ? kChunkEdge : 0)) return {};
  if (vertex.kind != SGM_VERTEX_LATERAL) return key;
  const auto side = [](int local) { return local == 0 ? size_t{0} : local == kChunkEdge ? size_t{2} : size_t{1}; };
  key.fan = seam->fans[side(at[(axis + 2) % 3])][side(at[(axis + 1) % 3])];
  return key;
}

size_t VertexKeyHash::operator()(const VertexKey& key) const {
  const uint64_t xy = uint64_t{static_cast<uint32_t>(key.corner.x)} << 32 | static_cast<uint32_t>(key.corner.y);
  const uint64_t rest = uint64_t{static_cast<uint32_t>(key.corner.z)} << 32 | uint64_t{key.level} << 16 |
                        uint64_t{key.axis} << 8 | key.fan;
  return hashCombine(xy, rest);
}

}  // namespace sgm::cli
