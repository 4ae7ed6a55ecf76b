#pragma once
// Finds fans that the surface cannot contain, by exact integer tests, for mesh/sharp_loops.h.

#include <functional>

#include "mesh/sharp_loops.h"

namespace sgm {

/// True if a fan has no triangles, one without area, or two that intersect other than in their common corners and
/// edges.
bool hasFault(const LoopTriangles& fan);

/// While a loop's fan intersects a triangle of another loop, the loop gets another centre, or is rounded. Loops that
/// are not sharp keep their triangles. isSound: whether a fan that has lost face vertices may stay. takeNextCentre:
/// gives a loop the next centre that makes a sound fan; false if no centre is left. Throws std::bad_alloc.
void roundUntilValid(SharpLoops& sharp, const std::function<bool(const LoopTriangles&)>& isSound,
                     const std::function<bool(SharpLoop&)>& takeNextCentre, std::pmr::memory_resource* memory);

}  // namespace sgm
