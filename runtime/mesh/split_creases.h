#pragma once
// Splits a mesh along its creases, so that the surface on each side of a crease is drawn with its own normals.

#include "mesh/weld.h"

namespace sgm {

/// Duplicates feature vertices (mesh/sharpen.h): each side of the crease gets a copy with that side's attributes.
/// Positions and keys do not change, and triangles keep their shape: vertices with equal keys are copies of one vertex
/// of the original mesh. Throws std::bad_alloc.
WorldMesh splitCreases(const WorldMesh& mesh, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Splits the creases of a part in place, as the function above does, and recomputes its hash.
void splitCreases(MeshPart& part, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
