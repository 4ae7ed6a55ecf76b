#pragma once
// For drawing sharp features: each side of a crease with its own normal.

#include "mesh/weld.h"

namespace sgm {

/// Feature vertices (mesh/sharpen.h) once for each side of their crease, with that side's attributes. Positions, keys
/// and triangles stay: vertices with equal keys are one in the mesh that this comes from. Throws std::bad_alloc.
WorldMesh splitCreases(const WorldMesh& mesh, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// As above, in place; hashes the part anew.
void splitCreases(MeshPart& part, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
