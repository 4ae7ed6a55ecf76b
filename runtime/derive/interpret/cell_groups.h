#pragma once
// Groups of a derived cell.

#include <vector>

#include "derive/bounds.h"
#include "derive/interpret/cell_context.h"
#include "derive/interpret/env.h"
#include "derive/shape.h"

namespace sgm::interpret {

/// Appends a group to `out` for each shape of a list, and leaves out what exceeds cellLimit(), with a note. cut: the
/// shapes cut the domain. Changes the draft: shapes lose children that are left out.
void collectGroups(const ShapeList& list, bool cut, CellContext& c, GrammarChunk& out);

/// Appends a group to `out` for each shape of a list, whatever its bounds. Returns false if a shape is unbounded that
/// does not cut. bounds: of the draft.
bool collectAlone(const ShapeList& list, bool cut, const ShapeBounds& bounds, const CellContext& c,
                  std::vector<Group>& out);

}  // namespace sgm::interpret
