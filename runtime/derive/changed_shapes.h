#pragma once
// Finds the differences between two derivations of one cell, so that only the affected chunks are meshed again.

#include <limits>
#include <vector>

#include "derive/shape.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// A box in which two derivations differ, at levels with cell edges from finest_cell to coarsest_cell, both in units.
struct ChangedShape {
  /// contains the changed solid, as Group::bounds does; the field may also differ outside, by the level's influence
  /// margin
  IntBox box;
  int32_t finest_cell = 0, coarsest_cell = std::numeric_limits<int32_t>::max();
  bool anchor = false;  ///< an anchor moved, appeared or disappeared; the box is one point, and the field is unchanged

  friend bool operator==(const ChangedShape&, const ChangedShape&) = default;
};

/// A derived cell and its program, which defines the meaning of the shapes' material and tag indices.
struct CellContent {
  const Program& program;
  const GrammarChunk* chunk = nullptr;  ///< null: the cell does not exist
};

/// Returns the groups and anchors that only one of the two cells has; a group or anchor with a changed position, size,
/// label, key or expression counts as different. Ignores notes and the order in memory. Materials and tags differ if
/// either their index or their name does.
std::vector<ChangedShape> changedShapes(const CellContent& before, const CellContent& after);

}  // namespace sgm
