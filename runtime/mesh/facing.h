#pragma once
// Checks the orientation of triangles of features.

#include "mesh/creases.h"
#include "mesh/loop_triangles.h"

namespace sgm {

/// True if each triangle except slivers, and the sum of all, faces out of the solid according to the tangents at its
/// vertices. Triangles whose corners are all feature vertices are exempt, because features have no tangent. creases:
/// settled, of the part whose vertices the triangles name.
bool facesOut(const LoopTriangles& triangles, const Creases& creases);

}  // namespace sgm
