#pragma once
// Face vertices in the faces of chunks, which depend only on the field near them.

#include <memory_resource>
#include <span>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// The sharp sides in the faces of a chunk, sorted, with the places of their face vertices. Throws std::bad_alloc.
std::pmr::vector<SharpSide> borderSides(const BodyLoops& body, const Creases& creases, const FieldSampler& field,
                                        std::pmr::memory_resource* memory);

/// Places the face vertices of the sides at the border: where the side's two tangent planes and the face meet, in the
/// side's own square or the adjacent one. If that point is off the surface, because a third plane cuts it off
/// (SharpSide::third), the side gets two places, where this plane meets the others and the face, or else one on it. A
/// side gets no place if these are too far away or off the surface, too; if the surface passes through its square
/// twice; or if the rounded loop would intersect another one, of its own cell or of adjacent cells
/// (mesh/rounded_cells.h).
///
/// Pure; both chunks at a face and the seam between them get the same result. grid: of the sides' level, whose chunks
/// begin at multiples of 32 cells; its origin is a multiple of a cell. keys: of the vertices that the sides join.
/// Samples the field up to sharpReach() away from the sides' squares. Throws std::bad_alloc.
void placeBorderVertices(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases,
                         const RawVector<VertexKey>& keys, std::span<SharpSide> sides,
                         std::pmr::memory_resource* memory);

}  // namespace sgm
