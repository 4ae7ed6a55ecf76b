#pragma once
// Which fans a surface cannot have, by exact tests in integers: the verdicts of mesh/sharp_loops.h.

#include "mesh/sharp_loops.h"

namespace sgm {

/// Whether all triangles of a loop's fan about a centre, with all of its face vertices, have an area, and meet each
/// other only where they are joined.
bool isSoundFan(const SharpLoops& sharp, const SharpLoop& loop, const FanCentre& centre);

/// A loop whose fan meets a triangle of another loop wrongly gets a spare centre, or is rounded, until no fan does.
/// Loops that are not sharp keep their triangles. Throws std::bad_alloc.
void roundUntilValid(SharpLoops& sharp, std::pmr::memory_resource* memory);

}  // namespace sgm
