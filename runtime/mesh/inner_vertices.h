#pragma once
// Places the face vertices within a chunk.
//
// Face vertices must follow a crease in the order of the sides that they belong to. The point on the crease nearest to
// a side's middle is not enough: where the crease passes near a corner of the grid, these points may be in another
// order than the sides, or coincide. Therefore a face vertex is placed at the mean of its own such point, with weight
// two, and of the points of the next sides in the two loops that share it. Three consecutive sides span more than one
// cell, so that the means are in order. Face vertices whose crease is cut off by a third plane are excepted.

#include <memory_resource>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// Places the face vertices of all sides that are not in a face of the chunk, on the crease of the tangent planes of
/// the side's ends. If that point is off the surface because a third plane cuts the crease off (SharpSide::third), the
/// position is on the crease of the third plane and of one end's plane. A side gets no position if that point is off
/// the surface or too far away. sharp: has its sides; those in faces of the chunk already have positions. Throws
/// std::bad_alloc.
void placeInnerVertices(const Creases& creases, const FieldSampler& field, SharpLoops& sharp,
                        std::pmr::memory_resource* memory);

}  // namespace sgm
