#pragma once
// Finds closed parts of a surface that features have swallowed: fans grew around such a part without intersecting it,
// so that a separate part now lies within the solid, or a cavity in the void.

#include <memory_resource>

#include "mesh/sharp_loops.h"

namespace sgm {

/// Rounds the fans near swallowed parts; returns whether there were any. Examines only parts without a vertex in a face
/// of the chunk, because features do not leave the chunk and so cannot swallow a part that does. Throws std::bad_alloc.
bool roundAroundSwallowed(SharpLoops& sharp, std::pmr::memory_resource* memory);

}  // namespace sgm
