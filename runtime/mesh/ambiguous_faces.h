#pragma once
// Ambiguous faces of the cells of a sharp body.
//
// A face of a cell is AMBIGUOUS if its solid and void corners alternate. Marching cubes separates the two solid corners
// there (mesh/case_rule.h), so that a part of the solid that is thinner than the diagonal of a face, such as the corner
// of a box, is cut off from the rest, and blunt. Here the field decides: if the diagonal between the two solid corners
// lies in the solid, and a crease passes through the face, the solid corners are joined and the surface goes around the
// void corners.

#include <optional>
#include <span>

#include "mesh/body_loops.h"
#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Returns the triangles of a body whose ambiguous faces follow the field; nullopt if they do not change. Both cells of
/// a face agree. A face stays as meshed if it lies in a face of the chunk; or if the loops of a cell beside it would
/// have no triangles, or triangles that intersect (mesh/triangle_faults.h), either as they are or with the face
/// vertices at the chunk's border.
///
/// Pure. creases: of all vertices of the body, settled. border: borderSides of the body. Samples the field only within
/// the chunk. Throws std::bad_alloc.
std::optional<RawVector<uint32_t>> resolveAmbiguousFaces(const BodyLoops& body, const Creases& creases,
                                                         std::span<const SharpSide> border, const FieldSampler& field,
                                                         std::pmr::memory_resource* memory);

}  // namespace sgm
