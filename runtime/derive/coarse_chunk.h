#pragma once
// What coarse levels have of a chunk, for caches: most shapes of a city are windows that no far level shows.

#include <vector>

#include "derive/shape.h"

namespace sgm {

/// The chunk without what no level shows whose cells have this edge (units) or a larger one, and without anchors and
/// notes. At these levels it compiles to the same program as the whole chunk: what field/compile.cpp leaves out with a
/// shape is left out with it here.
GrammarChunk coarseChunk(const GrammarChunk& chunk, int32_t cell_edge,
                         std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Which shapes of the chunk show at levels whose cells have this edge (units), and takes the others out of those that
/// do. left_out: a flag for each shape, also for those that are to go at every level.
std::vector<bool> hideShapes(GrammarChunk& chunk, int32_t cell_edge, const std::vector<bool>& left_out);

/// The largest cells at which a shape may show by itself; the largest number where it shows at every level.
int32_t coarsestOf(const GrammarChunk& chunk, const Shape& s);

/// Whether a shape that levels may leave out of this one leaves the rest of it as it is: the operand with that index.
bool isFreePart(ShapeKind of, uint32_t operand);

}  // namespace sgm
