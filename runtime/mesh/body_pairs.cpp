#include "mesh/body_pairs.h"

#include <algorithm>

#include "mesh/triangle_faults.h"

namespace sgm {
namespace {

// Cell coordinates start two cells below the chunk, so that feature vertices somewhat beyond the chunk can be compared,
// too.
constexpr int kBelow = 2, kCells = kChunkCells + 2 * kBelow + 1;
constexpr int kLeast = -kBelow * kSubcell, kMost = (kChunkCells + kBelow) * kSubcell;
constexpr int kMaxSpan = 4 * kSubcell;
/// Limits the comparisons within one cell: a triangle is compared with at most kMaxInCell - 1 triangles that follow it.
/// A body without defects has at most a dozen triangles per cell.
constexpr size_t kMaxInCell = 64;

using Cell = std::array<int, 3>;

int cellAt(int coordinate) { return (coordinate >> 8) + kBelow; }
uint32_t numberOf(const Cell& cell) { return static_cast<uint32_t>((cell[2] * kCells + cell[1]) * kCells + cell[0]); }

class PairCounter {
 public:
  PairCounter(std::span<const PairCorner> corners, PairScratch& scratch)
      : corners_(corners), scratch_(scratch), triangles_(scratch.triangles) {}

  PairCounts run() {
    look();
    if (wide_ > 0) {
      listByCell();
      for (uint32_t t = 0; t < triangles_.size(); ++t)
        if (triangles_[t].wide && triangles_[t].home != kLeftOut) compareWide(t);
    }
    compareInCells();
    return counts_;
  }

 private:
  static constexpr uint32_t kLeftOut = UINT32_MAX;

  void look() {
    const size_t count = corners_.size() / 3;
    triangles_.resize(count);
    uint32_t last = 0;
    bool sorted = true;
    for (size_t t = 0; t < count; ++t) {
      const PairCorner &a = corners_[3 * t], &b = corners_[3 * t + 1], &c = corners_[3 * t + 2];
      PairTriangle& triangle = triangles_[t];
      triangle.low = {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})};
      triangle.high = {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
      bool inside = true, beyond = false;
      Cell home{};
      for (size_t axis = 0; axis < 3; ++axis) {
        const int low = triangle.low[axis], high = triangle.high[axis];
        inside &= low >= kLeast && high <= kMost && high - low <= kMaxSpan;
        beyond |= high > ((low >> 8) + 1) * kSubcell;
        home[axis] = cellAt(low);
      }
      triangle.wide = beyond || isFeature(a.kind) || isFeature(b.kind) || isFeature(c.kind);
      triangle.home = inside ? numberOf(home) : kLeftOut;
      if (!inside) continue;
      wide_ += triangle.wide;
      if (triangle.wide) continue;
      sorted &= triangle.home >= last;
      last = triangle.home;
    }
    if (sorted) return;
    // The triangles are not sorted by cell: another program has made this body. Then all triangles count as wide, and
    // each is compared with all triangles near it.
    wide_ = count;
    for (PairTriangle& triangle : triangles_) triangle.wide = true;
  }

  /// Compares the pairs of triangles that lie within one cell. Skips triangles that are wide (PairTriangle::wide).
  void compareInCells() {
    const size_t count = triangles_.size();
    for (size_t t = 0; t + 1 < count; ++t) {
      const PairTriangle& triangle = triangles_[t];
      if (triangle.wide || triangle.home == kLeftOut) continue;
      const size_t end = std::min(count, t + kMaxInCell);
      for (size_t other = t + 1; other < end; ++other) {
        if (triangles_[other].wide) continue;
        if (triangles_[other].home != triangle.home) break;
        compare(t, other);
      }
    }
  }

  /// Returns the range of cells that the triangle's bounding box enters. If the box ends exactly at the low face of a
  /// cell, that cell does not count.
  void cellsOf(const PairTriangle& triangle, Cell& low, Cell& high) const {
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = cellAt(triangle.low[axis]);
      high[axis] = std::max(low[axis], cellAt(triangle.high[axis] - 1));
    }
  }

  template <class Visit>
  static void forCells(const Cell& low, const Cell& high, const Visit& visit) {
    Cell cell{};
    for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2])
      for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
        for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0]) visit(cell);
  }

  void listByCell() {
    std::pmr::vector<uint32_t>& first = scratch_.first;
    first.assign(size_t{kCells} * kCells * kCells + 1, 0);
    const auto forAll = [&](auto&& visit) {
      for (uint32_t t = static_cast<uint32_t>(triangles_.size()); t-- > 0;) {
        if (triangles_[t].home == kLeftOut) continue;
        Cell low, high;
        cellsOf(triangles_[t], low, high);
        forCells(low, high, [&](const Cell& cell) { visit(numberOf(cell), t); });
      }
    };
    forAll([&](uint32_t cell, uint32_t) { ++first[cell]; });
    uint32_t sum = 0;
    for (uint32_t& at : first) at = sum += at;
    scratch_.listed.resize(sum);
    // Fills each list from its end, so that first[cell] finally is the start of the cell's list.
    forAll([&](uint32_t cell, uint32_t t) { scratch_.listed[--first[cell]] = t; });
  }

  void compareWide(uint32_t t) {
    const PairTriangle& triangle = triangles_[t];
    // Includes the cells that the triangle only touches, because triangles in these cells may touch it.
    Cell from, to;
    for (size_t axis = 0; axis < 3; ++axis) {
      from[axis] = std::max(0, cellAt(triangle.low[axis] - 1));
      to[axis] = cellAt(triangle.high[axis]);
    }
    forCells(from, to, [&](const Cell& cell) {
      const uint32_t number = numberOf(cell);
      for (uint32_t at = scratch_.first[number]; at < scratch_.first[number + 1]; ++at) {
        const uint32_t other = scratch_.listed[at];
        const PairTriangle& seen = triangles_[other];
        if (other == t || (seen.wide && other < t)) continue;
        bool here = true;
        for (size_t axis = 0; axis < 3; ++axis) {
          here &= seen.low[axis] <= triangle.high[axis] && triangle.low[axis] <= seen.high[axis];
          // Two triangles may be listed together in several cells. They are compared only in the first of these cells.
          here &= std::max(from[axis], cellAt(seen.low[axis])) == cell[axis];
        }
        if (here) compare(t, other);
      }
    });
  }

  void compare(size_t a, size_t b) {
    std::array<PairCorner, 3> first{corners_[3 * a], corners_[3 * a + 1], corners_[3 * a + 2]};
    std::array<PairCorner, 3> second{corners_[3 * b], corners_[3 * b + 1], corners_[3 * b + 2]};
    const int shared = sharedFirst(first, second);
    const auto places = [](const std::array<PairCorner, 3>& t) {
      return std::array<Int3, 3>{{{t[0].x, t[0].y, t[0].z}, {t[1].x, t[1].y, t[1].z}, {t[2].x, t[2].y, t[2].z}}};
    };
    switch (TrianglePair<IntegerSigns>::faultOf(places(first), places(second), shared)) {
      case PairFault::none:
        break;
      case PairFault::folded:
        ++counts_.folded;
        break;
      case PairFault::cut:
        ++counts_.cut;
        break;
    }
  }

  std::span<const PairCorner> corners_;
  PairScratch& scratch_;
  std::pmr::vector<PairTriangle>& triangles_;
  size_t wide_ = 0;
  PairCounts counts_;
};

}  // namespace

PairCounts countPairs(std::span<const PairCorner> corners, PairScratch& scratch) {
  return PairCounter(corners, scratch).run();
}

}  // namespace sgm
