#pragma once
// The topology of a chunk's triangles, determined vertex by vertex.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace sgm::measure {

struct StarCounts {
  uint32_t vertices = 0;  ///< used by a triangle
  uint32_t edges = 0;
  uint32_t open_edges = 0;                    ///< with one triangle, and not in a border plane
  uint32_t turned_edges = 0;                  ///< with two triangles that use it in the same direction
  uint32_t nonmanifold_edges = 0;             ///< with more than two
  uint32_t pinched_vertices = 0;              ///< whose triangles form more than one fan
  uint32_t duplicate_triangles = 0;           ///< with the vertices of an earlier one
  std::array<uint32_t, 6> border_edges = {};  ///< with one triangle, in a border plane, by Face
};

/// A triangle's corner at its vertex: the next and the previous vertex. One word, since writing two words and reading
/// them as one is slow.
struct Corner {
  uint64_t word;
  static Corner of(uint32_t next, uint32_t previous) { return {uint64_t{previous} << 32 | next}; }
  uint32_t next() const { return static_cast<uint32_t>(word); }
  uint32_t previous() const { return static_cast<uint32_t>(word >> 32); }
};

/// Memory that is reused for several chunks: fresh pages would take longer than the work itself. Not thread-safe.
struct StarScratch {
  std::pmr::vector<uint32_t> first;  ///< index of the first corner of a vertex
  std::pmr::vector<Corner> corners;
  std::pmr::vector<uint64_t> seen;  ///< by vertex: the last vertex that met it, and below its position in that star

  explicit StarScratch(std::pmr::memory_resource* memory) : first(memory), corners(memory), seen(memory) {}
};

/// indices: three per triangle, all below planes.size(), the three of a triangle distinct. planes: one per vertex; bit
/// (1 << Face) of a vertex in that border plane; higher bits are ignored. Throws std::bad_alloc.
StarCounts countStars(std::span<const uint32_t> indices, std::span<const uint8_t> planes, StarScratch& scratch);

}  // namespace sgm::measure
