#pragma once
// Closed parts of a surface that features have swallowed: fans grew round such a part without meeting it, so
// that the part stands in the solid that it stood beside, or a cavity in the open.

#include <memory_resource>

#include "mesh/sharp_loops.h"

namespace sgm {

/// Rounds the fans near such parts, and returns whether there were any. Looked at are the parts that have no vertex in
/// a face of the chunk: features do not leave it, so that none grows round another part. Throws std::bad_alloc.
bool roundAroundSwallowed(SharpLoops& sharp, std::pmr::memory_resource* memory);

}  // namespace sgm
