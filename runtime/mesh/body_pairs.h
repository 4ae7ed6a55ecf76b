#pragma once
// Counts pairs of a body's triangles that fold over or cut each other (mesh/triangle_faults.h).

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

/// A corner of a body's triangle: its position, in 1/256 of the cell, and its vertex kind.
struct PairCorner {
  int16_t x = 0, y = 0, z = 0;
  uint16_t kind = 0;

  /// Compares positions only.
  friend bool operator==(const PairCorner& a, const PairCorner& b) {
    return ((a.x ^ b.x) | (a.y ^ b.y) | (a.z ^ b.z)) == 0;
  }
};

/// A triangle for the counting.
struct PairTriangle {
  std::array<int16_t, 3> low, high;  ///< its bounding box
  uint32_t home = 0;                 ///< the cell of its lowest coordinates
  bool wide = false;                 ///< reaches beyond that cell, or has a feature vertex
};

/// Memory that is reused for several bodies. Not thread-safe.
struct PairScratch {
  std::pmr::vector<PairTriangle> triangles;
  std::pmr::vector<uint32_t> first, listed;  ///< triangles by cell

  explicit PairScratch(std::pmr::memory_resource* memory) : triangles(memory), first(memory), listed(memory) {}
};

/// corners: three per triangle. Corners at equal positions are common corners. Triangles within their cell meet those
/// of other cells only in the cells' faces, along sides that they share or that are open; so such triangles are
/// compared only within their cell, and wide ones with all. Triangles that leave the chunk by more than two cells, or
/// span more than four along an axis, are left out: other measures report them. Takes about 15 ns per triangle, or 0.3
/// us if it is wide. Throws std::bad_alloc.
PairCounts countPairs(std::span<const PairCorner> corners, PairScratch& scratch);

}  // namespace sgm
