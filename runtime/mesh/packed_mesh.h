#pragma once
// The mesh of one chunk as delivered: body and seams concatenated in one vertex array and one index array.

#include <array>
#include <span>

#include "mesh/chunk.h"

namespace sgm {

/// A body or a seam inside a packed mesh.
struct PackedRange {
  uint32_t first_vertex = 0, vertex_count = 0, first_index = 0, index_count = 0;
  ContentHash hash;  ///< of this range's own vertices and indices (mesh/hash.h)
  friend bool operator==(const PackedRange&, const PackedRange&) = default;
};

struct PackedMesh {
  RawVector<Vertex> vertices;           ///< body first, then the seams by face
  RawVector<uint32_t> indices;          ///< into vertices, from the array's beginning; three per triangle
  std::array<PackedRange, 7> ranges{};  ///< body, then seams by Face; empty if absent

  explicit PackedMesh(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : vertices(memory), indices(memory) {}

  size_t bytes() const { return vertices.capacity() * sizeof(Vertex) + indices.capacity() * sizeof(uint32_t); }
};

/// parts[0] is the body, parts[1 + Face] a seam; null or empty if absent.
using MeshParts = std::array<const MeshPart*, 7>;

/// Concatenates parts. Ranges of `before` that `parts` lacks are copied, so that seams can be added to a mesh: its body
/// then keeps the same bytes at the same place. Throws std::bad_alloc.
PackedMesh packMesh(const MeshParts& parts, const PackedMesh* before, std::pmr::memory_resource* memory);

/// Packs a body alone; its arrays are moved if they were allocated from `memory`. Throws std::bad_alloc.
PackedMesh packBody(MeshPart&& body, std::pmr::memory_resource* memory);

/// Bounds in units that contain every vertex, including seams; all 0 if there is none.
IntBox boundsOf(const ChunkGrid& grid, std::span<const Vertex> vertices);

/// The tags of the vertices, ascending, without 0.
std::pmr::vector<uint16_t> tagsOf(std::span<const Vertex> vertices, std::pmr::memory_resource* memory);

/// Same as hashParts of body and seams.
ContentHash hashOf(const PackedMesh& mesh, const ChunkGrid& grid);

}  // namespace sgm
