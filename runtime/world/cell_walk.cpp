#include "world/cell_walk.h"

#include <algorithm>
#include <array>
#include <string>

namespace sgm {

namespace {

constexpr int64_t kMaxCellsOfChunk = int64_t{1} << 20, kMaxCellsWalked = int64_t{1} << 24;

}  // namespace

IntBox movedBy(const IntBox& box, Int3 by) { return {saturatingAdd(box.lo, by), saturatingAdd(box.hi, by)}; }

CellKey cellKey(const Program& program, int32_t finest_cell, uint32_t layer, Int3 at, int32_t cell_edge) {
  // Each derivation of a cell serves kLevelsTogether consecutive levels. A cached derivation for finer levels is never
  // reduced to serve coarser levels: the content of a chunk must not depend on the content of the cache.
  constexpr int kLevelsTogether = 2;
  int32_t kept = finest_cell;
  while (kept <= (cell_edge >> kLevelsTogether)) kept <<= kLevelsTogether;
  // kept = 0 stands for the complete cell. In a grammar with layers, even the finest level may not show everything in
  // a cell: with cells of 50 cm, for example, houses have no glazing bars. So this level does not use the complete
  // cell. But derivation of the layers above reads these finer parts, too, and so requests the complete cell.
  const Layer& info = program.layers[layer];
  if (!info.by_level || cell_edge < finest_cell || (kept == finest_cell && isWhole(info))) kept = 0;
  return {layer, at, kept};
}

Result<void> walkCells(const Program& program, Int3 shift, uint32_t layer, const IntBox& box, CellsBy by,
                       const std::function<Result<void>(const CellKey&)>& visit) {
  const Layer& info = program.layers[layer];
  // In a grammar without layers, or a layer without cells, all content belongs to one cell.
  if (info.cell_expr == kNoId || isWhole(info)) return visit({layer, {}});
  const IntBox home =
      movedBy(box, {saturate(-int64_t{shift.x}), saturate(-int64_t{shift.y}), saturate(-int64_t{shift.z})});
  std::array<int64_t, 3> first{}, last{};
  const int64_t most = by == CellsBy::shapes ? kMaxCellsOfChunk : kMaxCellsWalked;
  int64_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    const int64_t edge = info.cell[axis];
    ShapeSpan span = by == CellsBy::shapes ? shapeSpan(program, info, axis) : reachSpan(program, info, axis);
    if (by == CellsBy::ownership && edge > 0) span = {0, edge - 1};
    if (edge == 0) {
      if (home.hi[axis] < span.lo || home.lo[axis] > span.hi) return {};
      continue;
    }
    // Exclude cells that would extend beyond the border of the world: such cells are not derived.
    const int64_t world_first = floorDiv(int64_t{INT32_MIN} + edge - 1, edge),
                  world_last = floorDiv(INT32_MAX, edge) - 1;
    first[a] = std::max(-floorDiv(span.hi - home.lo[axis], edge), world_first);
    last[a] = std::min(floorDiv(home.hi[axis] - span.lo, edge), world_last);
    if (last[a] < first[a]) return {};
    count *= last[a] - first[a] + 1;
    if (count > most) {
      const std::string what = "more than " + std::to_string(most) + " cells of the layer `" +
                               std::string(program.text(info.name)) + "` reach into ";
      return Error{Code::limit, by == CellsBy::shapes
                                    ? what + "one chunk; make the layer's cells larger, or mesh at a finer level"
                                    : what + "the box; choose a smaller box, or make the layer's cells larger"};
    }
  }
  for (int64_t z = first[2]; z <= last[2]; ++z) {
    for (int64_t y = first[1]; y <= last[1]; ++y) {
      for (int64_t x = first[0]; x <= last[0]; ++x) {
        if (Result<void> visited = visit({layer, {saturate(x), saturate(y), saturate(z)}}); !visited) return visited;
      }
    }
  }
  return {};
}

}  // namespace sgm
