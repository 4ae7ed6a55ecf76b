#pragma once
// Places the face vertices (mesh/sharp_loops.h) inside a chunk.
//
// Along a crease, face vertices must have the order of their sides. The points on the crease that are nearest to the
// sides' middles do not ensure this: where the crease passes near a corner of the grid, they may have another order, or
// coincide. Therefore a face vertex is placed at the mean of the nearest point of its own side, with weight two, and of
// the nearest points of the next sides in the two loops that share its side. Three consecutive sides span more than one
// cell, so that the means are in order. Face vertices whose crease is cut off by a third plane are placed differently.

#include <memory_resource>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Places a face vertex on each sharp loop side inside the chunk. (A side is a segment of a surface loop on a cell's
/// face. Sides on faces of the chunk are placed earlier, by placeBorderVertices().) The face vertex lies on the crease
/// in which the tangent planes of the side's two ends meet. If that point is off the surface because a third plane cuts
/// the crease off (SharpSide::third), the face vertex lies on the crease between the third plane and the plane of one
/// end. A side gets no position if this point, too, is off the surface or too far away. sharp: the caller has filled in
/// sharp.sides, and the positions (`places`) of sides on faces of the chunk; this function sets the positions of the
/// other sides. Throws std::bad_alloc.
void placeInnerVertices(const Creases& creases, const FieldSampler& field, SharpLoops& sharp,
                        std::pmr::memory_resource* memory);

}  // namespace sgm
