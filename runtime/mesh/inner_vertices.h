#pragma once
// Face vertices within a chunk.
//
// The order of face vertices along a crease follows from the places nearest to the sides' middles; but where the crease
// passes near a corner of the grid these may come in another order than the sides, or fall together. Each face vertex
// that no third plane cuts off is therefore placed at the mean of its own such place, which counts twice, and those of
// the next sides of the two loops that it joins: three sides on span more than one cell, so that the means come in
// order.

#include <memory_resource>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Gives the sides that are not at the border a place on the crease of their ends' planes. Where that lies off the
/// surface, since a third plane cuts it off (SharpSide::third), the place is on the crease of this and an end's. A side
/// gets no place where that is off the surface, too, or too far away. sharp: with its sides, those at the border with
/// their places. Throws std::bad_alloc.
void placeInnerVertices(const Creases& creases, const FieldSampler& field, SharpLoops& sharp,
                        std::pmr::memory_resource* memory);

}  // namespace sgm
