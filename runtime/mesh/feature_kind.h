#pragma once
// The encoding of a feature vertex in Vertex::kind, so that its key follows from the kind and the position alone.
//
//   bit 15     1: a feature vertex
//   bit 14     0: a face vertex, 1: a cell vertex
//   bit 13     0: of the chunk's own level, 1: of the level above, only in seams
//   bits 6-11  face vertex: bits 6 and 7 the face's normal axis, 8 to 11 VertexKey::fan; cell vertex: 6 to 9 the fan
//   bits 0-5   two bits per axis: 1 + floor((vertex - key's corner) / cell), in cells of the vertex's level

#include "mesh/chunk.h"

namespace sgm {

inline constexpr uint16_t kFeature = 1 << 15, kFeatureOfCell = 1 << 14, kFeatureOfCoarser = 1 << 13;

constexpr bool isFeature(uint16_t kind) { return (kind & kFeature) != 0; }

/// True if a vertex of this kind takes its attributes from the field one level coarser than its chunk.
constexpr bool isOfCoarserLevel(uint16_t kind) {
  return isFeature(kind) ? (kind & kFeatureOfCoarser) != 0 : kind == kCoarserEdge;
}

/// Encodes a feature vertex. place: its position relative to the key's corner, in 1/256 of a cell of the key's level,
/// -256..512.
constexpr uint16_t featureKind(const VertexKey& key, const Int3& place, int chunk_level) {
  uint32_t kind = kFeature;
  if (key.axis == kCellVertex) {
    kind |= kFeatureOfCell | uint32_t{key.fan} << 6;
  } else {
    kind |= static_cast<uint32_t>(key.axis - kFaceVertex) << 6 | uint32_t{key.fan} << 8;
  }
  if (key.level != chunk_level) kind |= kFeatureOfCoarser;
  for (int axis = 0; axis < 3; ++axis) kind |= static_cast<uint32_t>(1 + (place[axis] >> 8)) << 2 * axis;
  return static_cast<uint16_t>(kind);
}

/// Returns the key of a feature vertex. Precondition: isFeature(vertex.kind).
constexpr VertexKey featureKey(const ChunkGrid& grid, const Vertex& vertex) {
  const bool coarser = isOfCoarserLevel(vertex.kind), of_cell = (vertex.kind & kFeatureOfCell) != 0;
  const Int3 at{vertex.x, vertex.y, vertex.z};
  VertexKey key;
  for (int axis = 0; axis < 3; ++axis) {
    const int32_t above = (vertex.kind >> 2 * axis & 3) - 1;
    key.corner[axis] = grid.origin[axis] + (((at[axis] >> (coarser ? 9 : 8)) - above) * grid.cell << (coarser ? 1 : 0));
  }
  key.level = static_cast<uint8_t>(grid.level + (coarser ? 1 : 0));
  key.axis = static_cast<uint8_t>(of_cell ? kCellVertex : kFaceVertex + (vertex.kind >> 6 & 3));
  key.fan = static_cast<uint8_t>(of_cell ? vertex.kind >> 6 & 15 : vertex.kind >> 8 & 15);
  return key;
}

}  // namespace sgm
