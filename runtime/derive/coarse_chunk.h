#pragma once
// Reduces a grammar chunk to the shapes that coarse levels show, to save cache memory: most shapes of a city are
// windows, which no coarse level shows.

#include <vector>

#include "derive/shape.h"

namespace sgm {

/// Returns a copy without anchors, notes, and shapes that are invisible at all levels with cell edges of `cell_edge`
/// units or more. At these levels the copy compiles to the same field program as the original: shapes that
/// field/compile.cpp drops because another shape is dropped are also removed.
GrammarChunk coarseChunk(const GrammarChunk& chunk, int32_t cell_edge,
                         std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Determines which shapes are visible at levels with this cell edge in units. Removes the other shapes from their
/// parents' children, and returns a flag for each shape: true if it is visible. left_out: a flag for each shape; true:
/// the shape is invisible at every level.
std::vector<bool> hideShapes(GrammarChunk& chunk, int32_t cell_edge, const std::vector<bool>& left_out);

/// Returns the largest cell edge at which the shape may be visible, according to its `detail` and the size of its
/// voxels; the maximum of int32 if it is visible at every level.
int32_t coarsestOf(const GrammarChunk& chunk, const Shape& s);

/// Whether the operand with this index of a shape of kind `of` can be omitted at a level of detail, while the rest of
/// the shape stays.
bool isFreePart(ShapeKind of, uint32_t operand);

}  // namespace sgm
