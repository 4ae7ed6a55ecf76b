#pragma once
// Places the face vertices (feature vertices on cell faces, mesh/sharp_loops.h) that lie in the faces of chunks. Their
// positions depend only on the field near them, so that adjacent chunks agree.

#include <memory_resource>
#include <span>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Returns the sharp loop sides (mesh/sharp_loops.h) in the faces of a chunk, sorted, with the positions of their face
/// vertices. Throws std::bad_alloc.
std::pmr::vector<SharpSide> borderSides(const BodyLoops& body, const Creases& creases, const FieldSampler& field,
                                        std::pmr::memory_resource* memory);

/// Places the face vertices of the loop sides in a face of the chunk (SharpSide::places). A side is a segment of a
/// surface loop in a face of a cell. Its face vertex lies where the tangent planes of the side's two ends meet the
/// face, in the side's own grid square or the adjacent one. If that point is off the surface because a third plane cuts
/// the crease off (SharpSide::third), the side gets two positions, where the third plane meets the face and each of the
/// two tangent planes; if these are unusable, it gets one position on the third plane. A side gets no position if
/// all of these points are too far away or off the surface; if the surface passes through its square twice; or if the
/// rounded loop would intersect another loop of its own cell or of adjacent cells (mesh/rounded_cells.h).
///
/// Pure; the result is the same for the chunks on both sides of a face and for the seam between them. grid: the grid of
/// the sides' level; its chunks begin at multiples of 32 cells, and its origin is a multiple of a cell. keys: the keys
/// of the vertices that SharpSide::from and to index. Samples the field up to sharpReach() away from the squares of the
/// sides. Throws std::bad_alloc.
void placeBorderVertices(const ChunkGrid& grid, const FieldSampler& field, const Creases& creases,
                         const RawVector<VertexKey>& keys, std::span<SharpSide> sides,
                         std::pmr::memory_resource* memory);

}  // namespace sgm
