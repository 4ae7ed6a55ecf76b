#include "derive/treemap.h"

#include <algorithm>
#include <numeric>

#include "base/math.h"

namespace sgm {
namespace {

/// The worst aspect ratio of a row of areas along a side of that length.
double worstOf(double least, double most, double sum, double side) {
  const double side2 = side * side, sum2 = sum * sum;
  return std::max(side2 * most / sum2, sum2 / (side2 * least));
}

int32_t snapped(double length, int32_t step) { return static_cast<int32_t>(detFloor(length / step + 0.5)) * step; }

}  // namespace

std::vector<PlanRect> squarifiedTreemap(const PlanRect& whole, std::span<const double> weights, int32_t step) {
  std::vector<size_t> order(weights.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return weights[a] > weights[b]; });
  std::vector<PlanRect> out(weights.size(), {whole.x0, whole.z0, whole.x0, whole.z0});
  PlanRect rest = whole;
  for (size_t first = 0; first < order.size();) {
    const bool column = rest.width() >= rest.depth();  // rows lie along the shorter side
    const double side = column ? rest.depth() : rest.width(), across = column ? rest.width() : rest.depth();
    if (!(side > 0 && across > 0)) break;
    double left = 0;
    for (size_t i = first; i < order.size(); ++i) left += weights[order[i]];
    const double scale = side * across / left;
    size_t end = first;
    double sum = 0;
    for (; end < order.size(); ++end) {
      const double next = weights[order[end]] * scale, most = weights[order[first]] * scale;
      if (end > first &&
          worstOf(next, most, sum + next, side) > worstOf(weights[order[end - 1]] * scale, most, sum, side))
        break;
      sum += next;
    }
    const int32_t thick = end == order.size() ? static_cast<int32_t>(across) : snapped(sum / side, step);
    double before = 0;
    for (size_t i = first; i < end; ++i) {
      const double after = before + weights[order[i]] * scale;
      const int32_t low = snapped(before / sum * side, step);
      const int32_t high = i + 1 == end ? static_cast<int32_t>(side) : snapped(after / sum * side, step);
      out[order[i]] = column ? PlanRect{rest.x0, rest.z0 + low, rest.x0 + thick, rest.z0 + high}
                             : PlanRect{rest.x0 + low, rest.z0, rest.x0 + high, rest.z0 + thick};
      before = after;
    }
    (column ? rest.x0 : rest.z0) += thick;
    first = end;
  }
  return out;
}

}  // namespace sgm
