#pragma once
// Pairs of a body's triangles that fold or cut each other (mesh/triangle_faults.h).

#include <memory_resource>
#include <span>
#include <vector>

#include "mesh/chunk.h"

namespace sgm {

struct PairCounts {
  uint32_t folded = 0, cut = 0;

  void operator+=(const PairCounts& other) { folded += other.folded, cut += other.cut; }
  friend bool operator==(const PairCounts&, const PairCounts&) = default;
};

/// A corner of a body's triangle: where it lies, in 1/256 of the cell, and what it is.
struct PairCorner {
  int16_t x = 0, y = 0, z = 0;
  uint16_t kind = 0;

  /// Of one place.
  friend bool operator==(const PairCorner& a, const PairCorner& b) {
    return ((a.x ^ b.x) | (a.y ^ b.y) | (a.z ^ b.z)) == 0;
  }
};

/// A triangle as the counting sees it.
struct PairTriangle {
  std::array<int16_t, 3> low, high;  ///< the box around it
  uint32_t home = 0;                 ///< the cell of its lowest coordinates
  bool wide = false;                 ///< reaches beyond that cell, or has a feature vertex
};

/// Memory that goes from body to body. One thread at a time.
struct PairScratch {
  std::pmr::vector<PairTriangle> triangles;
  std::pmr::vector<uint32_t> first, listed;  ///< triangles by cell

  explicit PairScratch(std::pmr::memory_resource* memory) : triangles(memory), first(memory), listed(memory) {}
};

/// corners: three a triangle. Corners are common where they lie in one place. Triangles without an edge beyond their
/// cell meet those of other cells in the cells' faces alone, in the sides that they share or that are open; so of them
/// only those of one cell are compared, and wide ones with all. Triangles that leave the chunk by more than two cells
/// or span more than four along an axis, which other measures tell of, are left out. Some 15 ns a triangle, 0.3 us
/// where it is wide. Throws std::bad_alloc.
PairCounts countPairs(std::span<const PairCorner> corners, PairScratch& scratch);

}  // namespace sgm
