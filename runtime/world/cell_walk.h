#pragma once
// Finds the cells of a layer whose shapes may reach into a box. A cell has several derivations, each for a range of
// levels of detail: also finds which of them a level uses.

#include <functional>

#include "base/result.h"
#include "derive/interpret/derive.h"
#include "world/cell_cache.h"

namespace sgm {

/// How the cells that matter in a box are selected: by the proven extent of their shapes, by their declared reach, or
/// by the points that they own.
enum class CellsBy { shapes, reach, ownership };

/// Calls visit for each cell of a layer that matters in the box, in order z, y, x, until the first error. shift: all
/// derived content was moved by this vector, in units. Error: limit if there are more than 2^20 cells by shapes, 2^24
/// otherwise.
Result<void> walkCells(const Program& program, Int3 shift, uint32_t layer, const IntBox& box, CellsBy by,
                       const std::function<Result<void>(const CellKey&)>& visit);

/// Returns the cache's key of a cell for levels whose cells have the edge cell_edge, in units. finest_cell: edge of the
/// cells of level 0.
CellKey cellKey(const Program& program, int32_t finest_cell, uint32_t layer, Int3 at, int32_t cell_edge);

/// Returns the box moved by a vector, saturated at the ends of the world.
IntBox movedBy(const IntBox& box, Int3 by);

}  // namespace sgm
