#pragma once
// Face vertices in the faces of chunks, which depend on the field beside them alone.

#include <memory_resource>
#include <span>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// The sharp sides in the faces of a chunk, sorted, with their places. Throws std::bad_alloc.
std::pmr::vector<SharpSide> borderSides(const BodyLoops& body, const Creases& creases, const FieldSampler& field,
                                        std::pmr::memory_resource* memory);

/// Gives those of the sides that are at the border a place where their two tangent planes and the face meet: in the
/// side's own square, or in the square beside it. Where that point lies off the surface, since a third plane cuts it
/// off (SharpSide::third), the side gets two places, in which this plane meets the others and the face, or else one on
/// it. A side gets no place where these are farther away or off the surface, too; where the surface passes through its
/// square twice; or where the rounded loop would meet another one, of its own cell or of those beside it
/// (mesh/rounded_cells.h).
///
/// Pure; both chunks at a face and the seam between them find the same. grid: of the sides' level, whose chunks begin
/// at multiples of 32 cells; its origin is a multiple of a cell. keys: of the vertices that the sides join. The field
/// is sampled up to sharpReach() away from the sides' squares. Throws std::bad_alloc.
void placeBorderVertices(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases,
                         const RawVector<VertexKey>& keys, std::span<SharpSide> sides,
                         std::pmr::memory_resource* memory);

}  // namespace sgm
