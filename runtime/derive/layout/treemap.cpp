#include "derive/layout/treemap.h"

#include <algorithm>
#include <numeric>

#include "base/math.h"

namespace sgm {
namespace {

/// Returns the worst aspect ratio among rectangles in a row along a side of length `side`. least, most, sum: the
/// smallest, the largest and the sum of their areas.
double worstOf(double least, double most, double sum, double side) {
  const double side2 = side * side, sum2 = sum * sum;
  return std::max(side2 * most / sum2, sum2 / (side2 * least));
}

int32_t snapped(double length, int32_t step) { return static_cast<int32_t>(detFloor(length / step + 0.5)) * step; }

/// The space that is not yet divided into rows.
struct Rest {
  PlanRect rect;
  double weight = 0;
  // whether the next row runs along z: rows run along the shorter side
  bool columns() const { return rect.width() >= rect.depth(); }
  double side() const { return columns() ? rect.depth() : rect.width(); }
  double across() const { return columns() ? rect.width() : rect.depth(); }
  /// Area for each unit of weight, in square units of length.
  double scale() const { return side() * across() / weight; }
};

/// Takes the next row from the remaining space and places the parts of the row.
void take(Rest& rest, const TreemapRow& row, std::span<const double> weights, int32_t step,
          std::vector<PlanRect>& out) {
  const bool columns = rest.columns();
  const double side = rest.side(), scale = rest.scale();
  double sum = 0;
  for (const size_t part : row.parts) sum += weights[part] * scale;
  const int32_t thick = row.last ? static_cast<int32_t>(rest.across()) : snapped(sum / side, step);
  PlanRect& r = rest.rect;
  const int32_t near = columns ? (row.behind ? r.x1 - thick : r.x0) : (row.behind ? r.z1 - thick : r.z0);
  double before = 0;
  for (const size_t part : row.parts) {
    const double after = before + weights[part] * scale;
    const int32_t low = snapped(before / sum * side, step);
    const int32_t high = part == row.parts.back() ? static_cast<int32_t>(side) : snapped(after / sum * side, step);
    out[part] = columns ? PlanRect{near, r.z0 + low, near + thick, r.z0 + high}
                        : PlanRect{r.x0 + low, near, r.x0 + high, near + thick};
    before = after;
  }
  (columns ? (row.behind ? r.x1 : r.x0) : (row.behind ? r.z1 : r.z0)) += row.behind ? -thick : thick;
}

std::vector<size_t> largestFirst(std::span<const double> weights) {
  std::vector<size_t> order(weights.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return weights[a] > weights[b]; });
  return order;
}

double weightFrom(std::span<const size_t> order, std::span<const double> weights) {
  double sum = 0;
  for (const size_t part : order) sum += weights[part];
  return sum;
}

}  // namespace

std::vector<TreemapRow> squarifiedRows(const PlanRect& whole, std::span<const double> weights, int32_t step) {
  const std::vector<size_t> order = largestFirst(weights);
  std::vector<PlanRect> places(weights.size());
  std::vector<TreemapRow> rows;
  Rest rest{whole};
  for (size_t first = 0; first < order.size();) {
    rest.weight = weightFrom(std::span(order).subspan(first), weights);
    const double side = rest.side(), scale = rest.scale();
    if (!(side > 0 && rest.across() > 0)) break;
    size_t end = first;
    double sum = 0;
    for (; end < order.size(); ++end) {
      const double next = weights[order[end]] * scale, most = weights[order[first]] * scale;
      if (end > first &&
          worstOf(next, most, sum + next, side) > worstOf(weights[order[end - 1]] * scale, most, sum, side))
        break;
      sum += next;
    }
    TreemapRow row;
    row.parts.assign(order.begin() + static_cast<std::ptrdiff_t>(first),
                     order.begin() + static_cast<std::ptrdiff_t>(end));
    row.last = end == order.size();
    take(rest, row, weights, step, places);
    rows.push_back(std::move(row));
    first = end;
  }
  return rows;
}

std::vector<PlanRect> placedRows(const PlanRect& whole, std::span<const double> weights,
                                 std::span<const TreemapRow> rows, int32_t step) {
  std::vector<PlanRect> out(weights.size(), {whole.x0, whole.z0, whole.x0, whole.z0});
  const std::vector<size_t> order = largestFirst(weights);
  Rest rest{whole};
  size_t first = 0;
  for (const TreemapRow& row : rows) {
    rest.weight = weightFrom(std::span(order).subspan(first), weights);
    take(rest, row, weights, step, out);
    first += row.parts.size();
  }
  return out;
}

std::vector<PlanRect> squarifiedTreemap(const PlanRect& whole, std::span<const double> weights, int32_t step) {
  return placedRows(whole, weights, squarifiedRows(whole, weights, step), step);
}

}  // namespace sgm
