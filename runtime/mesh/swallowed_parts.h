#pragma once
// Finds closed parts of a surface that features have swallowed: the fans of other parts grew around such a part without
// intersecting it, so that it now lies within the solid or, if it is a cavity, within the void.

#include <memory_resource>

#include "mesh/sharp_loops.h"

namespace sgm {

/// Rounds the loops whose fans lie near swallowed parts (mesh/sharp_loops.h); returns whether it rounded any loop.
/// Examines only parts without a vertex in a face of the chunk, because features do not leave the chunk and so cannot
/// swallow a part that does. Throws std::bad_alloc.
bool roundAroundSwallowed(SharpLoops& sharp, std::pmr::memory_resource* memory);

}  // namespace sgm
