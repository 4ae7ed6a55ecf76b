#pragma once
// Resolves ambiguous faces in the body of a chunk with sharp features.
//
// A face of a cell is AMBIGUOUS if its solid and void corners alternate. Marching cubes separates the two solid corners
// of such a face (mesh/case_rule.h). This cuts off a part of the solid that is thinner than the diagonal of a face,
// such as the corner of a box, and blunts it. Here the field decides: if the diagonal between the two solid corners
// lies in the solid, and a crease passes through the face, the solid corners are joined and the surface goes around the
// void corners.

#include <optional>
#include <span>

#include "mesh/body_loops.h"
#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Returns the body's triangles (three indices each) after the field has resolved its ambiguous faces; nullopt if no
/// triangle changes. The result for a face is the same in the two cells that share it. An ambiguous face stays as
/// marching cubes made it in three cases: it lies in a face of the chunk; the new loops of a cell beside it cannot be
/// triangulated; or their triangles would intersect others (mesh/triangle_faults.h). Loops with face vertices in faces
/// of the chunk are tested with these vertices.
///
/// Pure. creases: holds the tangents of all vertices of the body; settle() has been called. border: the result of
/// borderSides() for the body. Samples the field only within the chunk. Throws std::bad_alloc.
std::optional<RawVector<uint32_t>> resolveAmbiguousFaces(const BodyLoops& body, const Creases& creases,
                                                         std::span<const SharpSide> border, const FieldSampler& field,
                                                         std::pmr::memory_resource* memory);

}  // namespace sgm
