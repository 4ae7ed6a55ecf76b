#pragma once
// Splits creases for drawing, so that each side has its own normal.

#include "mesh/weld.h"

namespace sgm {

/// Duplicates feature vertices (mesh/sharpen.h): each side of the crease gets a copy with that side's attributes.
/// Positions and keys do not change, and triangles keep their shape: vertices with equal keys are copies of one vertex
/// of the original mesh. Throws std::bad_alloc.
WorldMesh splitCreases(const WorldMesh& mesh, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Same as above, in place; recomputes the part's hash.
void splitCreases(MeshPart& part, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
