#pragma once
// Finds those cells of a grammar's layer whose shapes may reach into a box. A cell has several derivations, each for a
// range of levels of detail: cellKey() tells which of them a level uses.

#include <functional>

#include "base/result.h"
#include "derive/interpret/derive.h"
#include "world/cell_cache.h"

namespace sgm {

/// The region of a cell that is tested for intersection with a box: the proven extent of its shapes (shapes), the
/// declared maximum extent of its shapes (reach), or the cell itself (ownership).
enum class CellsBy { shapes, reach, ownership };

/// Calls visit for each cell of a layer whose region (CellsBy) intersects the box, in order z, y, x, until the first
/// error. shift: all derived content was moved by this vector, in units. Error: limit if there are more than 2^20 cells
/// (with CellsBy::shapes) or more than 2^24 cells (otherwise).
Result<void> walkCells(const Program& program, Int3 shift, uint32_t layer, const IntBox& box, CellsBy by,
                       const std::function<Result<void>(const CellKey&)>& visit);

/// Returns the key under which the cache stores a grammar cell, for those levels of detail whose grid cells have the
/// edge cell_edge, in units. finest_cell: edge of the grid cells of level 0.
CellKey cellKey(const Program& program, int32_t finest_cell, uint32_t layer, Int3 at, int32_t cell_edge);

/// Returns the box moved by a vector, saturated at the ends of the world.
IntBox movedBy(const IntBox& box, Int3 by);

}  // namespace sgm
