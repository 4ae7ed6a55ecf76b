#pragma once
// Reduces a chunk for the caches of coarse levels: most shapes of a city are windows that no far level shows.

#include <vector>

#include "derive/shape.h"

namespace sgm {

/// The chunk without shapes that are invisible at all levels with this cell edge (units) or a larger one, and without
/// anchors and notes. At these levels it compiles to the same program as the whole chunk: everything that
/// field/compile.cpp leaves out with a shape is also left out here.
GrammarChunk coarseChunk(const GrammarChunk& chunk, int32_t cell_edge,
                         std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Determines which shapes of the chunk show at levels with this cell edge (units), and removes the others from them.
/// left_out: a flag for each shape, set for those to remove at every level, too.
std::vector<bool> hideShapes(GrammarChunk& chunk, int32_t cell_edge, const std::vector<bool>& left_out);

/// The largest cell edge at which a shape may show by itself; the largest number if it shows at every level.
int32_t coarsestOf(const GrammarChunk& chunk, const Shape& s);

/// True if a shape stays unchanged when levels leave out the operand with that index.
bool isFreePart(ShapeKind of, uint32_t operand);

}  // namespace sgm
