#pragma once
// Triangulates loops with sharp features (mesh/sharp_loops.h): as a fan around a centre, or as a strip.

#include <cstdint>
#include <functional>
#include <span>

#include "mesh/loop_triangles.h"

namespace sgm {

/// A point of a fan: its centre, or a point of the ring around it. The ring consists of the loop's vertices and of the
/// face vertices of its sides. A face vertex follows the vertex at which its side begins.
struct FanPoint {
  Int3 at;            ///< position in 1/256 of a cell
  uint32_t name = 0;  ///< the vertex's name, as in NamedTriangle (mesh/loop_triangles.h)
  bool is_feature = false;
};

/// Returns the triangles from a centre to each segment of the ring. They exist for any ring, and stay within the convex
/// hull of the points. is_closed: true if the last and the first point of the ring form a triangle with the centre,
/// too; false if the centre is itself the point of the ring between these two.
LoopTriangles coneTriangles(const FanPoint& centre, std::span<const FanPoint> ring, bool is_closed);

/// Returns whether a loop may have a diagonal between the points with these names: false if another loop may have it,
/// too.
using IsFree = std::function<bool(uint32_t a, uint32_t b)>;

/// Same as coneTriangles, but with other diagonals in patches where the cone would fold. The creases from the centre to
/// the face vertices divide the surface into patches, each of them approximately planar. If the centre does not see all
/// of a patch, the cone's triangles in it do not all face one way. Such a patch gets other diagonals, with which all of
/// its triangles face one way; among several choices, the one whose smallest triangle is largest. If no diagonals
/// achieve this, the patch keeps the cone.
///
/// A triangle whose corners are all features is followed by another triangle of its patch, so that splitCreases() finds
/// on which side of the crease it lies; the triangle between the two face vertices of one side is an exception. Returns
/// no triangles if a diagonal would not be free (see IsFree).
LoopTriangles patchTriangles(const FanPoint& centre, std::span<const FanPoint> ring, bool is_closed,
                             const IsFree& is_free);

/// Returns triangles without a centre, for a ring that several creases pass through. Each crease joins two consecutive
/// face vertices of the ring, and cuts off the patch between them. Only every other pair of consecutive face vertices
/// is joined by a crease: the first crease starts at the first face vertex or, if `from_second`, at the second. The
/// remaining patch lies between the creases. A triangle whose corners are all features is followed by another triangle
/// of its patch.
///
/// Returns no triangles if the number of face vertices is odd, if a diagonal would not be free, if the triangles of a
/// patch would not all face one way, or if the remaining patch has no vertex.
LoopTriangles stripTriangles(std::span<const FanPoint> ring, bool from_second, const IsFree& is_free);

}  // namespace sgm
