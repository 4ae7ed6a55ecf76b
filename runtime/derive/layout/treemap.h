#pragma once
// Squarified treemaps: divide a rectangle into nearly square parts of given areas. After Bruls, Huizing, van Wijk,
// Squarified Treemaps, VisSym 2000, section 3.

#include <cstdint>
#include <span>
#include <vector>

namespace sgm {

/// A rectangle of the x-z plane, in units; x0 < x1 and z0 < z1 unless it is empty.
struct PlanRect {
  int32_t x0 = 0, z0 = 0, x1 = 0, z1 = 0;
  int32_t width() const { return x1 - x0; }
  int32_t depth() const { return z1 - z0; }
  friend bool operator==(const PlanRect&, const PlanRect&) = default;
};

/// A row of a squarified treemap: parts side by side along the shorter side of the space left by previous rows.
struct TreemapRow {
  std::vector<size_t> parts;  ///< indices of the parts, from the low end of the row
  /// true: the row lies at the high end of the remaining space's longer side; false: at the low end
  bool behind = false;
  bool last = false;  ///< true: the row fills all of the remaining space
};

/// Divides the weights, in descending order, into rows. Each row has the number of parts that makes its parts most
/// nearly square. The caller may move a row to the other end of the remaining space, or permute its parts: this changes
/// the lengths of the parts' edges by at most `step`. weights: 1e-6 to 1e6.
std::vector<TreemapRow> squarifiedRows(const PlanRect& whole, std::span<const double> weights, int32_t step);

/// Returns the rectangles of the parts of rows from squarifiedRows(). The caller may have permuted the parts of rows
/// and changed `behind`.
std::vector<PlanRect> placedRows(const PlanRect& whole, std::span<const double> weights,
                                 std::span<const TreemapRow> rows, int32_t step);

/// Returns the rectangle of each weight, in the order of the weights. All borders between parts lie at multiples of
/// `step` from x0 and z0, and neighbours share them; parts thinner than a step are empty. weights: 1e-6 to 1e6.
std::vector<PlanRect> squarifiedTreemap(const PlanRect& whole, std::span<const double> weights, int32_t step);

}  // namespace sgm
