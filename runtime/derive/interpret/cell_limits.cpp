// Boxes of cells, and limits of the shapes of cells.

#include <algorithm>

#include "derive/interpret/derive.h"

namespace sgm {
namespace {

/// Returns how far (units) the bounds of a shape may exceed its proven bound: ShapeBounds::level() adds a margin for
/// float rounding, which grows with the size of the shape.
int64_t roundingOf(const IntBox& bound) {
  const IntBox all = IntBox::everything();
  int64_t longest = 0;
  for (int a = 0; a < 3; ++a) {
    if (bound.lo[a] > all.lo[a] && bound.hi[a] < all.hi[a]) {
      longest = std::max(longest, int64_t{bound.hi[a]} - bound.lo[a]);
    }
  }
  return longest >> 16;
}

}  // namespace

bool isWhole(const Layer& layer) { return layer.cell_expr == kNoId; }

IntBox cellBox(const Layer& layer, Int3 cell) {
  IntBox box = IntBox::everything();
  for (int a = 0; a < 3; ++a) {
    if (isWhole(layer) || layer.cell[a] <= 0) continue;
    box.lo[a] = saturate(int64_t{cell[a]} * layer.cell[a]);
    box.hi[a] = saturate((int64_t{cell[a]} + 1) * layer.cell[a] - 1);
  }
  return box;
}

IntBox cellLimit(const Program& program, uint32_t layer_index, Int3 cell) {
  const Layer& layer = program.layers[layer_index];
  if (isWhole(layer)) return program.domain.box.grown(kReachSlack);
  IntBox box = cellBox(layer, cell);
  for (int a = 0; a < 3; ++a) {
    if (layer.cell[a] <= 0) continue;
    box.lo[a] = saturate(int64_t{box.lo[a]} - layer.reach - kReachSlack);
    box.hi[a] = saturate(int64_t{box.hi[a]} + 1 + layer.reach + kReachSlack);
  }
  return box;
}

ShapeSpan reachSpan(const Program& program, const Layer& layer, int axis) {
  const IntBox all = IntBox::everything();
  if (isWhole(layer)) {
    return {int64_t{program.domain.box.lo[axis]} - kReachSlack, int64_t{program.domain.box.hi[axis]} + kReachSlack};
  }
  if (layer.cell[axis] <= 0) return {all.lo[axis], all.hi[axis]};
  const int64_t reach = int64_t{layer.reach} + kReachSlack;
  return {-reach, layer.cell[axis] + reach};
}

ShapeSpan shapeSpan(const Program& program, const Layer& layer, int axis) {
  const ShapeSpan reach = reachSpan(program, layer, axis);
  if (!layer.proven) return reach;
  const int64_t room = kReachSlack + roundingOf(layer.bound);
  return {std::max(reach.lo, layer.bound.lo[axis] - room), std::min(reach.hi, layer.bound.hi[axis] + room)};
}

IntBox shapeLimit(const Program& program, uint32_t layer_index, Int3 cell) {
  const Layer& layer = program.layers[layer_index];
  IntBox box;
  for (int a = 0; a < 3; ++a) {
    const ShapeSpan span = shapeSpan(program, layer, a);
    const int64_t corner = isWhole(layer) ? 0 : int64_t{cell[a]} * layer.cell[a];
    box.lo[a] = saturate(corner + span.lo);
    box.hi[a] = saturate(corner + span.hi);
  }
  return box;
}

}  // namespace sgm
