#pragma once
// Face vertices in the faces of chunks, which depend on the field beside them alone.

#include <memory_resource>
#include <span>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Gives those of the sides that are at the border a place where their two tangent planes and the face meet: in the
/// side's own square, or, where the surface passes through the square beside it unseen by samples, in that one. Where
/// that point lies off the surface, since a third plane cuts it off, the place is on that plane (SharpSide::third). A
/// side gets no place where that is farther away or off the surface, too; where the surface passes through the square
/// twice, or so near to the point that another contour might cross the side's; where a cell beside it has another loop
/// that the rounded loop would meet (mesh/sharp_loops.h), or several loops and a sharp side in another face of the
/// chunk.
///
/// Pure; both chunks at a face and the seam between them find the same. grid: of the sides' level, whose chunks begin
/// at multiples of 32 cells; its origin is a multiple of a cell. keys: of the vertices that the sides join. The field
/// is sampled up to a cell and a unit away from the sides' squares. Throws std::bad_alloc.
void placeBorderVertices(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases,
                         const RawVector<VertexKey>& keys, std::span<SharpSide> sides,
                         std::pmr::memory_resource* memory);

}  // namespace sgm
