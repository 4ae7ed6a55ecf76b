#pragma once
// What differs between two derivations of one cell, so that only what depends on it is meshed again.

#include <limits>
#include <vector>

#include "derive/shape.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// A place that differs, for levels whose cells have an edge from finest to coarsest, in units.
struct ChangedShape {
  IntBox box;  ///< of solid, as Group::bounds: the field differs farther out, by as much as levels let groups reach
  int32_t finest_cell = 0, coarsest_cell = std::numeric_limits<int32_t>::max();
  bool anchor = false;  ///< a point alone: the field is the same

  friend bool operator==(const ChangedShape&, const ChangedShape&) = default;
};

/// A derived cell and its program, whose materials and tags the shapes have by number.
struct CellContent {
  const Program& program;
  const GrammarChunk* chunk = nullptr;  ///< null: there is no such cell
};

/// The groups and anchors of each that the other does not have: another place, size, label, key or expression. The
/// order of memory and notes do not count. A material or tag counts as another one where its number or its name is.
std::vector<ChangedShape> changedShapes(const CellContent& before, const CellContent& after);

}  // namespace sgm
