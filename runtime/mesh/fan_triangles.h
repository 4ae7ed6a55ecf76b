#pragma once
// The triangles of a loop about the centre of its features.

#include <cstdint>
#include <functional>
#include <span>

#include "mesh/loop_triangles.h"

namespace sgm {

/// A point of a fan: its centre, or on its ring a vertex of the loop, or a face vertex behind the vertex that begins
/// its side.
struct FanPoint {
  Int3 at;            ///< in 1/256 of a cell
  uint32_t name = 0;  ///< as in NamedTriangle
  bool is_feature = false;
};

/// The ring's triangles about a centre. Such a fan may have any ring, and stays within the convex hull of its points.
/// is_closed: a triangle joins the last of the ring to the first; it is false where the centre is a point between them.
LoopTriangles coneTriangles(const FanPoint& centre, std::span<const FanPoint> ring, bool is_closed);

/// Whether a loop may have a diagonal between two points, given by their names, which no other loop has.
using IsFree = std::function<bool(uint32_t a, uint32_t b)>;

/// As coneTriangles; but the surface is divided into patches by the creases from the centre to the face vertices, and a
/// patch that does not face one way as a part of the fan gets other diagonals with which it does, if there are such:
/// those of the largest smallest triangle. A patch of a solid's surface lies about in one plane, in which the centre
/// may be unable to see all of it. A triangle that joins features alone is followed by another one of its patch, but
/// for that between the two face vertices of one side. The result is empty if a diagonal would not be free.
LoopTriangles patchTriangles(const FanPoint& centre, std::span<const FanPoint> ring, bool is_closed,
                             const IsFree& is_free);

/// Without a centre, of a ring that creases pass through: each joins two face vertices that follow each other on the
/// ring, and cuts off the patch between them; the patch that is left lies between the creases. Every other patch is cut
/// off, from the first face vertex on or, if `from_second`, from the second. A triangle that joins features alone is
/// followed by another one of its patch. The result is empty if the number of face vertices is odd, if a diagonal would
/// not be free, if a patch would not face one way, or if one that is left has no vertex.
LoopTriangles stripTriangles(std::span<const FanPoint> ring, bool from_second, const IsFree& is_free);

}  // namespace sgm
