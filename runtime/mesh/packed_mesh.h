#pragma once
// One chunk's mesh as it is handed out: body and seams behind each other in one vertex array and one index array.

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
  RawVector<uint32_t> indices;          ///< into vertices, from the array's beginning; three a triangle
  std::array<PackedRange, 7> ranges{};  ///< body, then seams by Face; empty where there is none

  explicit PackedMesh(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : vertices(memory), indices(memory) {}

  size_t bytes() const { return vertices.capacity() * sizeof(Vertex) + indices.capacity() * sizeof(uint32_t); }
};

/// parts[0] is the body, parts[1 + Face] a seam; null or empty where there is none.
using MeshParts = std::array<const MeshPart*, 7>;

/// Parts behind each other. Ranges that `before` has and `parts` lacks are taken from it, so that seams can be added to
/// a mesh: its body then comes out with the same bytes at the same place. Throws std::bad_alloc.
PackedMesh packMesh(const MeshParts& parts, const PackedMesh* before, std::pmr::memory_resource* memory);

/// A body alone, whose arrays are taken over where their memory is `memory`. Throws std::bad_alloc.
PackedMesh packBody(MeshPart&& body, std::pmr::memory_resource* memory);

/// Bounds in units that hold every vertex, seams included; all 0 where there is none.
IntBox boundsOf(const ChunkGrid& grid, std::span<const Vertex> vertices);

/// The tags that vertices carry, rising, 0 left out.
std::pmr::vector<uint16_t> tagsOf(std::span<const Vertex> vertices, std::pmr::memory_resource* memory);

/// As hashParts of body and seams.
ContentHash hashOf(const PackedMesh& mesh, const ChunkGrid& grid);

}  // namespace sgm
