#pragma once
// Reduces a chunk for the caches of coarse levels: most shapes of a city are windows, which no coarse level shows.

#include <vector>

#include "derive/shape.h"

namespace sgm {

/// Returns a copy without anchors, notes, and shapes that are invisible at all levels with cell edges of `cell_edge`
/// units or more. At these levels the copy compiles to the same field program as the original: everything that
/// field/compile.cpp drops together with a shape is dropped here, too.
GrammarChunk coarseChunk(const GrammarChunk& chunk, int32_t cell_edge,
                         std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Determines which shapes are visible at levels with this cell edge in units. Removes the others from their parents'
/// children, and returns a flag for each shape: true if it is removed. left_out: a flag for each shape; true: remove it
/// at every level.
std::vector<bool> hideShapes(GrammarChunk& chunk, int32_t cell_edge, const std::vector<bool>& left_out);

/// Returns the largest cell edge at which the shape may be visible by its own settings; the maximum of int32 if it is
/// visible at every level.
int32_t coarsestOf(const GrammarChunk& chunk, const Shape& s);

/// Whether a shape of this kind keeps its other content unchanged when a level drops the operand with that index.
bool isFreePart(ShapeKind of, uint32_t operand);

}  // namespace sgm
