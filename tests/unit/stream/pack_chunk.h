#pragma once
// A chunk's parts behind each other.

#include "backend/backend.h"
#include "mesh/packed_mesh.h"

namespace sgm {

inline PackedMesh packChunk(const ChunkMesh& chunk) {
  PackedMesh packed;
  const auto append = [&](const MeshPart& part, PackedRange& range) {
    range.first_vertex = static_cast<uint32_t>(packed.vertices.size());
    range.vertex_count = static_cast<uint32_t>(part.vertices.size());
    range.first_index = static_cast<uint32_t>(packed.indices.size());
    range.index_count = static_cast<uint32_t>(part.indices.size());
    range.hash = part.hash;
    packed.vertices.insert(packed.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const uint32_t index : part.indices) packed.indices.push_back(range.first_vertex + index);
  };
  append(chunk.body, packed.ranges[0]);
  for (size_t face = 0; face < chunk.seams.size(); ++face) append(chunk.seams[face], packed.ranges[1 + face]);
  return packed;
}

}  // namespace sgm
