#pragma once
// What coarse levels have of a chunk, for caches: most shapes of a city are windows that no far level shows.

#include "derive/shape.h"

namespace sgm {

/// The chunk without what no level shows whose cells have this edge (units) or a larger one, and without anchors and
/// notes. At these levels it compiles to the same program as the whole chunk: what field/compile.cpp leaves out with a
/// shape is left out with it here.
GrammarChunk coarseChunk(const GrammarChunk& chunk, int32_t cell_edge,
                         std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
