#include "measure/weld_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace sgm::measure {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

struct Cell {
  uint64_t x, y, z;
  friend bool operator==(const Cell&, const Cell&) = default;
};

uint64_t mixed(uint64_t h) {
  h ^= h >> 32;
  h *= 0x9E3779B97F4A7C15u;
  return h ^ h >> 29;
}

uint64_t hashOf(const Cell& cell) { return mixed(cell.x + mixed(cell.y + mixed(cell.z + 0x2545F4914F6CDD1Du))); }

/// A hash table from a grid cell to the first of the kept points in it, the head of a linked list. Uses open
/// addressing; at most half full.
class Cells {
 public:
  Cells(size_t points, std::pmr::memory_resource* memory)
      : slots_(std::bit_ceil(std::max<size_t>(2 * points, 16)), kNone, memory) {}

  /// Returns the slot of a grid cell; if the table does not contain the cell, the empty slot in which to insert it.
  /// cellOf: returns the cell of a kept point.
  template <class CellOf>
  uint32_t& slot(const Cell& cell, CellOf&& cellOf) {
    size_t at = hashOf(cell) & (slots_.size() - 1);
    while (slots_[at] != kNone && !(cellOf(slots_[at]) == cell)) at = (at + 1) & (slots_.size() - 1);
    return slots_[at];
  }

 private:
  LargeVector<uint32_t> slots_;
};

Cell bitsOf(Point p) {
  // Adding 0 turns -0 into 0.
  return {std::bit_cast<uint64_t>(p.x + 0.0), std::bit_cast<uint64_t>(p.y + 0.0), std::bit_cast<uint64_t>(p.z + 0.0)};
}

/// Returns the cell that contains a point, in a grid with this edge length.
Point gridOf(Point p, double edge) { return {std::floor(p.x / edge), std::floor(p.y / edge), std::floor(p.z / edge)}; }

class Welder {
 public:
  /// Reserves memory for the case that no two points merge. Reserved pages that stay unused cost nothing, whereas an
  /// array that grows would be copied.
  Welder(size_t points, double tolerance, std::pmr::memory_resource* memory)
      : tolerance_(tolerance), cells_(points, memory), kept_(memory), next_(memory) {
    kept_.reserve(points);
  }

  uint32_t add(Point p) {
    const uint32_t found = tolerance_ > 0 ? near(p) : kNone;
    if (found != kNone) return found;
    const auto number = static_cast<uint32_t>(kept_.size());
    uint32_t& head = headOf(cellOf(p));
    if (tolerance_ == 0 && head != kNone) return head;
    kept_.push_back(p);
    if (tolerance_ > 0) next_.push_back(head);
    head = number;
    return number;
  }

  LargeVector<Point> take() { return std::move(kept_); }

 private:
  Cell cellOf(Point p) const { return bitsOf(tolerance_ > 0 ? gridOf(p, tolerance_) : p); }
  uint32_t& headOf(const Cell& cell) {
    return cells_.slot(cell, [this](uint32_t kept) { return cellOf(kept_[kept]); });
  }

  /// Returns the kept point with the lowest number within the tolerance of p; kNone if there is none.
  uint32_t near(Point p) {
    uint32_t best = kNone;
    const Point grid = gridOf(p, tolerance_);
    for (int n = 0; n < 27; ++n) {
      const Point offset{n % 3 - 1.0, n / 3 % 3 - 1.0, n / 9 - 1.0};
      for (uint32_t v = headOf(bitsOf(grid + offset)); v != kNone; v = next_[v])
        if (v < best && length(kept_[v] - p) <= tolerance_) best = v;
    }
    return best;
  }

  double tolerance_;
  Cells cells_;
  LargeVector<Point> kept_;
  /// for each kept point: the next kept point in the same grid cell; empty without a tolerance
  LargeVector<uint32_t> next_;
};

}  // namespace

WeldedPoints weldPoints(const Triangles& mesh, double tolerance) {
  // A tolerance below the rounding error of the largest coordinate is replaced by 0: at that coordinate, a double
  // cannot tell neighbouring grid cells of this size apart.
  double farthest = 0;
  for (const Point& p : mesh.points) {
    for (const double v : {p.x, p.y, p.z})
      if (std::fabs(v) <= kFarthest) farthest = std::max(farthest, std::fabs(v));
  }
  if (tolerance < farthest * std::numeric_limits<double>::epsilon()) tolerance = 0;
  WeldedPoints result{LargeVector<Point>(mesh.memory), LargeVector<Triangle>(mesh.memory)};
  result.triangles.reserve(mesh.triangles.size());
  LargeVector<uint32_t> place(mesh.points.size(), kNone, mesh.memory);
  size_t used = 0;
  Welder welder(std::min(mesh.points.size(), 3 * mesh.triangles.size()), tolerance, mesh.memory);
  for (const Triangle& t : mesh.triangles) {
    Triangle welded{};
    for (size_t k = 0; k < 3; ++k) {
      uint32_t& at = place[t[k]];
      if (at == kNone) {
        at = welder.add(mesh.points[t[k]]);
        ++used;
      }
      welded[k] = at;
    }
    result.triangles.push_back(welded);
  }
  result.points = welder.take();
  result.merged = used - result.points.size();
  return result;
}

}  // namespace sgm::measure
