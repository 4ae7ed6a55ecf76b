#pragma once
// Splits a mesh along its creases, so that the surface on each side of a crease is drawn with its own normals.

#include "mesh/weld.h"

namespace sgm {

/// Splits the mesh along its creases: replaces each feature vertex (mesh/sharpen.h) by one copy for each side of the
/// crease, with this side's attributes. Positions, keys and the shapes of triangles do not change: vertices with equal
/// keys are copies of one vertex of the original mesh. Throws std::bad_alloc.
WorldMesh splitCreases(const WorldMesh& mesh, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Splits the creases of a part in place, as the function above does, and recomputes its hash.
void splitCreases(MeshPart& part, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
