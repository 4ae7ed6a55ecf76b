#pragma once
// Checks that triangles with feature vertices face out of the solid.

#include "mesh/creases.h"
#include "mesh/loop_triangles.h"

namespace sgm {

/// Checks the orientation of triangles by the tangents at their vertices. True if every triangle except slivers faces
/// out of the solid, and if the sum of all triangles does so too. Triangles whose corners are all feature vertices are
/// exempt, because feature vertices have no tangent. creases: the creases, after settle(), of the part to whose
/// vertices the triangles refer.
bool facesOut(const LoopTriangles& triangles, const Creases& creases);

}  // namespace sgm
