#pragma once
// Finds closed parts of a surface that features have swallowed: fans grew around such a part without intersecting it,
// so that a separate part now lies within the solid, or a cavity in the void.

#include <memory_resource>

#include "mesh/sharp_loops.h"

namespace sgm {

/// Rounds the fans near such parts, and returns whether there were any. Examines only the parts without a vertex in a
/// face of the chunk: features do not leave it, so that none grows around another part. Throws std::bad_alloc.
bool roundAroundSwallowed(SharpLoops& sharp, std::pmr::memory_resource* memory);

}  // namespace sgm
