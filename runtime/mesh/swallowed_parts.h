#pragma once
// Small closed parts of a surface that a feature has swallowed: a fan grew round such a part without meeting it, so
// that the part stands in the solid that it stood beside, or a cavity in the open.

#include <memory_resource>

#include "mesh/sharp_loops.h"

namespace sgm {

/// Rounds the fans near such parts, and returns whether there were any. A part is small if its cells, of which none is
/// at the chunk's border, reach over at most three on each axis: no fan goes round a larger one. Throws std::bad_alloc.
bool roundAroundSwallowed(SharpLoops& sharp, std::pmr::memory_resource* memory);

}  // namespace sgm
