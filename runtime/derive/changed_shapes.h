#pragma once
// The differences between two derivations of one cell, so that only the dependent chunks are meshed again.

#include <limits>
#include <vector>

#include "derive/shape.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// A box that differs, for levels whose cells have an edge from finest to coarsest, in units.
struct ChangedShape {
  IntBox box;  ///< of solid, as Group::bounds: the field differs beyond it by the influence margin of the level
  int32_t finest_cell = 0, coarsest_cell = std::numeric_limits<int32_t>::max();
  bool anchor = false;  ///< a single point: the field is the same

  friend bool operator==(const ChangedShape&, const ChangedShape&) = default;
};

/// A derived cell and its program, which defines the shapes' material and tag numbers.
struct CellContent {
  const Program& program;
  const GrammarChunk* chunk = nullptr;  ///< null: there is no such cell
};

/// The groups and anchors that only one of the two has: with another position, size, label, key or expression. The
/// order in memory and notes are ignored. A material or tag differs if its number or its name does.
std::vector<ChangedShape> changedShapes(const CellContent& before, const CellContent& after);

}  // namespace sgm
