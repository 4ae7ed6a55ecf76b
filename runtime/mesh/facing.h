#pragma once
// Checks the orientation of triangles of features.

#include "mesh/creases.h"
#include "mesh/loop_triangles.h"

namespace sgm {

/// True if all triangles except slivers, and their sum, face out of the solid, according to the tangents of their
/// vertices: a triangle that joins only features may face any way. creases: settled, of the part that the triangles'
/// names refer to.
bool facesOut(const LoopTriangles& triangles, const Creases& creases);

}  // namespace sgm
