#pragma once
// Splits creases for drawing, so that each side has its own normal.

#include "mesh/weld.h"

namespace sgm {

/// Duplicates feature vertices (mesh/sharpen.h): one for each side of their crease, with that side's attributes.
/// Positions, keys and triangles stay: vertices with equal keys are one in the original mesh. Throws std::bad_alloc.
WorldMesh splitCreases(const WorldMesh& mesh, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Same as above, in place; recomputes the part's hash.
void splitCreases(MeshPart& part, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
