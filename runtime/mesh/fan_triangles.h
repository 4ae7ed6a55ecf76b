#pragma once
// The triangles of a loop around the centre of its features.

#include <cstdint>
#include <functional>
#include <span>

#include "mesh/loop_triangles.h"

namespace sgm {

/// A point of a fan: its centre, or a point on its ring, which is a vertex of the loop or a face vertex after the
/// vertex that begins its side.
struct FanPoint {
  Int3 at;            ///< in 1/256 of a cell
  uint32_t name = 0;  ///< as in NamedTriangle
  bool is_feature = false;
};

/// The triangles from a centre to the ring. Such a fan works for any ring, and stays within the convex hull of its
/// points. is_closed: a triangle joins the last point of the ring to the first; false if the centre is a point between
/// them.
LoopTriangles coneTriangles(const FanPoint& centre, std::span<const FanPoint> ring, bool is_closed);

/// True if a loop may have a diagonal between two points, given by their names: no other loop has it.
using IsFree = std::function<bool(uint32_t a, uint32_t b)>;

/// Same as coneTriangles; but the creases from the centre to the face vertices divide the surface into patches, and a
/// patch that does not face one way as part of the fan gets other diagonals, if some make it do so: those whose
/// smallest triangle is largest. A patch of a solid's surface lies approximately in one plane, in which the centre may
/// not see all of it. A triangle that joins only features is followed by another one of its patch, except the triangle
/// between the two face vertices of one side. The result is empty if a diagonal would not be free.
LoopTriangles patchTriangles(const FanPoint& centre, std::span<const FanPoint> ring, bool is_closed,
                             const IsFree& is_free);

/// Triangles without a centre, for a ring that creases pass through: each crease joins two consecutive face vertices of
/// the ring, and cuts off the patch between them; the remaining patch lies between the creases. Every other patch is
/// cut off, from the first face vertex on or, if `from_second`, from the second. A triangle that joins only features is
/// followed by another one of its patch. The result is empty if the number of face vertices is odd, if a diagonal would
/// not be free, if a patch would not face one way, or if a remaining patch has no vertex.
LoopTriangles stripTriangles(std::span<const FanPoint> ring, bool from_second, const IsFree& is_free);

}  // namespace sgm
