#pragma once
// Face vertices within a chunk.
//
// The order of face vertices along a crease follows from the points nearest to the sides' middles. If the crease passes
// near a corner of the grid, these points may be in another order than the sides, or coincide. Each face vertex that no
// third plane cuts off is therefore placed at the mean of its own such point, with weight two, and those of the next
// sides of the two loops that it joins: three consecutive sides span more than one cell, so that the means are in
// order.

#include <memory_resource>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Places the face vertices of the sides that are not at the border on the crease of their ends' planes. If that point
/// is off the surface, because a third plane cuts it off (SharpSide::third), the place is on the crease of this plane
/// and an end's. A side gets no place if that is off the surface, too, or too far away. sharp: with its sides, those at
/// the border with their places. Throws std::bad_alloc.
void placeInnerVertices(const Creases& creases, const FieldSampler& field, SharpLoops& sharp,
                        std::pmr::memory_resource* memory);

}  // namespace sgm
