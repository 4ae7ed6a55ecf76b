#pragma once
// The mesh of one chunk as delivered: body and seams concatenated in one vertex array and one index array.

#include <array>
#include <span>

#include "mesh/chunk.h"

namespace sgm {

/// A body or a seam inside a packed mesh.
struct PackedRange {
  uint32_t first_vertex = 0, vertex_count = 0, first_index = 0, index_count = 0;
  ContentHash hash;  ///< content hash of this range's own vertices and indices (mesh/hash.h)
  friend bool operator==(const PackedRange&, const PackedRange&) = default;
};

struct PackedMesh {
  RawVector<Vertex> vertices;  ///< body first, then the seams by face
  /// three per triangle; each is an index into the whole array `vertices`, not into the triangle's own range of it
  RawVector<uint32_t> indices;
  std::array<PackedRange, 7> ranges{};  ///< the body, then the seams by Face; empty if absent

  explicit PackedMesh(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : vertices(memory), indices(memory) {}

  size_t bytes() const { return vertices.capacity() * sizeof(Vertex) + indices.capacity() * sizeof(uint32_t); }
};

/// parts[0] is the body, parts[1 + Face] a seam; null or empty if absent.
using MeshParts = std::array<const MeshPart*, 7>;

/// Concatenates parts into one mesh. A part that is null in `parts` is copied from `before`, if that mesh has it. So
/// seams can be added to a mesh while its body keeps the same bytes at the same place. Throws std::bad_alloc.
PackedMesh packMesh(const MeshParts& parts, const PackedMesh* before, std::pmr::memory_resource* memory);

/// Packs a body without seams. Moves its arrays instead of copying them if they were allocated from `memory`. Throws
/// std::bad_alloc.
PackedMesh packBody(MeshPart&& body, std::pmr::memory_resource* memory);

/// Returns a box in units that contains every vertex, including those of seams; all 0 if there is no vertex.
IntBox boundsOf(const ChunkGrid& grid, std::span<const Vertex> vertices);

/// Returns the different tags of the vertices, ascending, without 0 (no tag).
std::pmr::vector<uint16_t> tagsOf(std::span<const Vertex> vertices, std::pmr::memory_resource* memory);

/// Returns the same hash as hashParts for the body and the seams.
ContentHash hashOf(const PackedMesh& mesh, const ChunkGrid& grid);

}  // namespace sgm
