#pragma once
// Converts the shapes of a derived cell to groups.

#include <vector>

#include "derive/bounds.h"
#include "derive/interpret/cell_context.h"
#include "derive/interpret/env.h"
#include "derive/shape.h"

namespace sgm::interpret {

/// Appends a group to `out` for each shape of a list. Leaves out shapes, or parts of shapes, that exceed cellLimit(),
/// with a note. cut: whether the shapes cut the domain. Modifies the draft: removes the children that are left out.
void collectGroups(const ShapeList& list, bool cut, CellContext& c, GrammarChunk& out);

/// Appends a group to `out` for each shape of a list, ignoring cellLimit(). Returns false if a shape has no bound and
/// `cut` is false. cut: whether the shapes cut the domain. bounds: computes bounds of the draft's shapes.
bool collectAlone(const ShapeList& list, bool cut, const ShapeBounds& bounds, const CellContext& c,
                  std::vector<Group>& out);

}  // namespace sgm::interpret
