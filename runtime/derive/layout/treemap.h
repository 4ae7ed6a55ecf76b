#pragma once
// Squarified treemaps: a rectangle in parts whose areas are as given and whose shapes are near squares. After Bruls,
// Huizing, van Wijk, Squarified Treemaps, VisSym 2000, section 3.

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

/// Parts side by side along the shorter side of what the rows before it have left.
struct TreemapRow {
  std::vector<size_t> parts;  ///< from the low end of that side
  bool behind = false;        ///< at the high end of the longer side
  bool last = false;          ///< fills what is left
};

/// Rows of weights that fall, each with as many as keep its parts nearest to squares. Which end of the rest a row lies
/// at and in which order its parts stand changes no part's shape, to the step. weights: 1e-6 to 1e6.
std::vector<TreemapRow> squarifiedRows(const PlanRect& whole, std::span<const double> weights, int32_t step);

/// The places of such rows, of which parts may have changed places within a row, and rows ends.
std::vector<PlanRect> placedRows(const PlanRect& whole, std::span<const double> weights,
                                 std::span<const TreemapRow> rows, int32_t step);

/// The part of each weight, in the order of the weights. All lines between parts lie on multiples of `step` from x0 and
/// z0, and neighbours share them; parts that are thinner than that come out empty. weights: 1e-6 to 1e6.
std::vector<PlanRect> squarifiedTreemap(const PlanRect& whole, std::span<const double> weights, int32_t step);

}  // namespace sgm
