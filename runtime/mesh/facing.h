#pragma once
// Which way triangles of features face.

#include "mesh/creases.h"
#include "mesh/loop_triangles.h"

namespace sgm {

/// Whether all triangles face out of the solid, but for slivers, and together do, by the tangents of the vertices that
/// they have: a triangle between features alone may face any way. creases: settled, of the part that the triangles are
/// named after.
bool facesOut(const LoopTriangles& triangles, const Creases& creases);

}  // namespace sgm
