#pragma once
// Finds the differences between two derivations of one cell, so that only the affected chunks are meshed again.

#include <limits>
#include <vector>

#include "derive/shape.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// A box in which two derivations differ, at the levels of detail whose cell edges lie between finest_cell and
/// coarsest_cell, in units.
struct ChangedShape {
  /// bounds of the changed solid; the field may also differ outside of this box, within the level's influence margin
  IntBox box;
  int32_t finest_cell = 0, coarsest_cell = std::numeric_limits<int32_t>::max();
  /// true: an anchor moved, appeared or disappeared; the box is one point, and the field is unchanged
  bool anchor = false;

  friend bool operator==(const ChangedShape&, const ChangedShape&) = default;
};

/// A derived cell, and the compiled grammar that defines the meaning of its material and tag indices.
struct CellContent {
  const Program& program;
  const GrammarChunk* chunk = nullptr;  ///< null if the cell does not exist
};

/// Returns the groups and anchors that exist in only one of the two derivations. If a group or anchor has a different
/// position, size, label, key or expression, both versions are returned. Ignores notes and the order in memory.
/// Materials and tags differ if either their index or their name differs.
std::vector<ChangedShape> changedShapes(const CellContent& before, const CellContent& after);

}  // namespace sgm
