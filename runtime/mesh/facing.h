#pragma once
// Checks that triangles with feature vertices face out of the solid.

#include "mesh/creases.h"
#include "mesh/loop_triangles.h"

namespace sgm {

/// True if each triangle except slivers, and the sum of all triangles, faces out of the solid according to the tangents
/// at its vertices. Triangles whose corners are all feature vertices are exempt, because feature vertices have no
/// tangent. creases: those of the part whose vertices the triangles index, after settle().
bool facesOut(const LoopTriangles& triangles, const Creases& creases);

}  // namespace sgm
