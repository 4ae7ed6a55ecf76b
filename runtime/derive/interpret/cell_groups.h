#pragma once
// Converts the shapes of a derived cell to groups.

#include <vector>

#include "derive/bounds.h"
#include "derive/interpret/cell_context.h"
#include "derive/interpret/env.h"
#include "derive/shape.h"

namespace sgm::interpret {

/// Appends a group to `out` for each shape of a list. Leaves out shapes, or parts of shapes, that exceed cellLimit(),
/// with a note. cut: the shapes cut the domain. Modifies the draft: removes the children that are left out.
void collectGroups(const ShapeList& list, bool cut, CellContext& c, GrammarChunk& out);

/// Appends a group to `out` for each shape of a list, ignoring cellLimit(). Returns false if the shapes add (`cut` is
/// false) and one has no bound. bounds: of the shapes in the draft.
bool collectAlone(const ShapeList& list, bool cut, const ShapeBounds& bounds, const CellContext& c,
                  std::vector<Group>& out);

}  // namespace sgm::interpret
