#pragma once
// Squarified treemaps: divide a rectangle into nearly square parts of given areas. After Bruls, Huizing, van Wijk,
// Squarified Treemaps, VisSym 2000, section 3.

#include <cstdint>
#include <span>
#include <vector>

namespace sgm {

/// A rectangle of the x-z plane, units. low < high.
struct PlanRect {
  int32_t x0 = 0, z0 = 0, x1 = 0, z1 = 0;
  int32_t width() const { return x1 - x0; }
  int32_t depth() const { return z1 - z0; }
  friend bool operator==(const PlanRect&, const PlanRect&) = default;
};

/// Parts side by side along the shorter side of the space that previous rows left.
struct TreemapRow {
  std::vector<size_t> parts;  ///< from the low end of that side
  bool behind = false;        ///< at the high end of the longer side
  bool last = false;          ///< fills the remaining space
};

/// Rows of descending weights, each with the number of parts that makes them most nearly square. The end at which a row
/// lies, and the order of its parts, do not change the shape of a part, up to the step. weights: 1e-6 to 1e6.
std::vector<TreemapRow> squarifiedRows(const PlanRect& whole, std::span<const double> weights, int32_t step);

/// The rectangles of such rows, after parts may have been permuted within a row, and rows moved to the other end.
std::vector<PlanRect> placedRows(const PlanRect& whole, std::span<const double> weights,
                                 std::span<const TreemapRow> rows, int32_t step);

/// The part of each weight, in the order of the weights. All lines between parts lie on multiples of `step` from x0 and
/// z0, and neighbours share them; thinner parts are empty. weights: 1e-6 to 1e6.
std::vector<PlanRect> squarifiedTreemap(const PlanRect& whole, std::span<const double> weights, int32_t step);

}  // namespace sgm
