#pragma once
// How a chunk's triangles hang together, told vertex by vertex.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace sgm::measure {

struct StarCounts {
  uint32_t vertices = 0;  ///< that a triangle has
  uint32_t edges = 0;
  uint32_t open_edges = 0;                    ///< with one triangle, and not in a border plane
  uint32_t turned_edges = 0;                  ///< with two triangles that go along it in one direction
  uint32_t nonmanifold_edges = 0;             ///< with more than two
  uint32_t pinched_vertices = 0;              ///< whose triangles are more than one fan
  uint32_t duplicate_triangles = 0;           ///< with the vertices of an earlier one
  std::array<uint32_t, 6> border_edges = {};  ///< with one triangle, in a border plane, by Face
};

/// A triangle's corner as its vertex sees it: the vertices that come next and before. One word, since what is written
/// in two is slow to read as one.
struct Corner {
  uint64_t word;
  static Corner of(uint32_t next, uint32_t previous) { return {uint64_t{previous} << 32 | next}; }
  uint32_t next() const { return static_cast<uint32_t>(word); }
  uint32_t previous() const { return static_cast<uint32_t>(word >> 32); }
};

/// Memory that goes from chunk to chunk: fresh pages would take longer than what is done in them. One thread at a time.
struct StarScratch {
  std::pmr::vector<uint32_t> first;  ///< of a vertex's corners
  std::pmr::vector<Corner> corners;
  std::pmr::vector<uint64_t> seen;  ///< by vertex: which other has met it last, and below where in its star

  explicit StarScratch(std::pmr::memory_resource* memory) : first(memory), corners(memory), seen(memory) {}
};

/// indices: three a triangle, all below planes.size(), no two of a triangle equal. planes, one a vertex: bit (1 <<
/// Face) of a vertex in that border plane; bits above are not read. Throws std::bad_alloc.
StarCounts countStars(std::span<const uint32_t> indices, std::span<const uint8_t> planes, StarScratch& scratch);

}  // namespace sgm::measure
