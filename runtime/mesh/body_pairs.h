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

/// The bounding box of a triangle, and the cell that the triangle belongs to. countPairs() finds nearby triangles from
/// them.
struct PairTriangle {
  std::array<int16_t, 3> low, high;  ///< bounding box, in 1/256 of a cell
  uint32_t home = 0;                 ///< index of the cell that contains the lowest corner of the bounding box
  bool wide = false;                 ///< true if the triangle reaches beyond the cell `home`, or has a feature vertex
};

/// Working memory of countPairs(), reused from body to body. Not thread-safe.
struct PairScratch {
  std::pmr::vector<PairTriangle> triangles;
  std::pmr::vector<uint32_t> first, listed;  ///< triangle indices, grouped by cell in `listed`, from `first[cell]` on

  explicit PairScratch(std::pmr::memory_resource* memory) : triangles(memory), first(memory), listed(memory) {}
};

/// Counts the folded and the cut pairs among a body's triangles. corners: three per triangle; corners at equal
/// positions count as one common corner.
///
/// If two triangles each lie within one cell, but in different cells, they can meet only in the face between the cells,
/// along a side that both share or that is open. Therefore a triangle within one cell is compared only with those of
/// the same cell, and a wide triangle (PairTriangle::wide) with all triangles near it. Ignores triangles that leave the
/// chunk by more than two cells or span more than four cells along an axis: other measures report them. Takes about 15
/// ns per triangle, or 0.3 us per wide triangle. Throws std::bad_alloc.
PairCounts countPairs(std::span<const PairCorner> corners, PairScratch& scratch);

}  // namespace sgm
