#pragma once
// The topology of a chunk's triangles, determined vertex by vertex from the triangles around each (its star).

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace sgm::measure {

struct StarCounts {
  uint32_t vertices = 0;  ///< vertices that a triangle uses
  uint32_t edges = 0;
  uint32_t open_edges = 0;                    ///< number of edges with only one triangle that lie in no border plane
  uint32_t turned_edges = 0;                  ///< misoriented edges: two triangles use them in the same direction
  uint32_t nonmanifold_edges = 0;             ///< edges of more than two triangles
  uint32_t pinched_vertices = 0;              ///< non-manifold vertices: their triangles form more than one fan
  uint32_t duplicate_triangles = 0;           ///< triangles with the same vertices as an earlier one
  std::array<uint32_t, 6> border_edges = {};  ///< number of edges with only one triangle in each border plane, by Face
};

/// A triangle as seen from one of its vertices: the next and the previous vertex. Stored in one word, since writing two
/// words and reading them as one is slow.
struct Corner {
  uint64_t word;
  static Corner of(uint32_t next, uint32_t previous) { return {uint64_t{previous} << 32 | next}; }
  uint32_t next() const { return static_cast<uint32_t>(word); }
  uint32_t previous() const { return static_cast<uint32_t>(word >> 32); }
};

/// Working memory of countStars(), reused for several chunks, because touching fresh pages would take longer than the
/// work itself. Not thread-safe.
struct StarScratch {
  std::pmr::vector<uint32_t> first;  ///< index of the first corner at each vertex
  std::pmr::vector<Corner> corners;
  /// by vertex w: the vertex v in whose star w was found last (high half), and the position of w in that star (low
  /// half)
  std::pmr::vector<uint64_t> seen;

  explicit StarScratch(std::pmr::memory_resource* memory) : first(memory), corners(memory), seen(memory) {}
};

/// Counts the topology of a chunk's triangles. indices: three per triangle, which must differ from each other, and all
/// below planes.size(). planes: one per vertex, with bit (1 << Face) set if the vertex lies in that border plane;
/// higher bits are ignored. Throws std::bad_alloc.
StarCounts countStars(std::span<const uint32_t> indices, std::span<const uint8_t> planes, StarScratch& scratch);

}  // namespace sgm::measure
