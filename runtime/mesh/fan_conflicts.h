#pragma once
// Which fans a surface cannot have, by exact tests in integers: the verdicts of mesh/sharp_loops.h.

#include <functional>

#include "mesh/sharp_loops.h"

namespace sgm {

/// Whether a fan has no triangles, one without area, or two that meet but where they are joined.
bool hasFault(const LoopTriangles& fan);

/// A loop whose fan meets a triangle of another loop wrongly gets another centre, or is rounded, until no fan does.
/// Loops that are not sharp keep their triangles. isSound: whether a fan that has lost face vertices may stay.
/// takeNextCentre: gives a loop the next centre that makes a sound fan; false if no centre is left. Throws
/// std::bad_alloc.
void roundUntilValid(SharpLoops& sharp, const std::function<bool(const LoopTriangles&)>& isSound,
                     const std::function<bool(SharpLoop&)>& takeNextCentre, std::pmr::memory_resource* memory);

}  // namespace sgm
