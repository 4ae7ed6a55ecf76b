#pragma once
// Finds fans (mesh/sharp_loops.h) that intersect themselves or other loops, by exact integer tests, and replaces them.

#include <functional>

#include "mesh/sharp_loops.h"

namespace sgm {

/// True if a fan is empty, or has a triangle without area, or has two triangles that intersect beyond their common
/// corners and edges.
bool hasFault(const LoopTriangles& fan);

/// As long as a fan intersects a triangle of another loop, or is no longer sound after it has lost face vertices, gives
/// the fan another centre or, if no centre is left, rounds the loop (mesh/sharp_loops.h). Loops that are not sharp keep
/// their triangles. isSound: returns whether a fan may stay although it has lost face vertices. takeNextCentre: gives a
/// loop the next centre whose fan is valid; returns false if no centre is left. Throws std::bad_alloc.
void roundUntilValid(SharpLoops& sharp, const std::function<bool(const LoopTriangles&)>& isSound,
                     const std::function<bool(SharpLoop&)>& takeNextCentre, std::pmr::memory_resource* memory);

}  // namespace sgm
