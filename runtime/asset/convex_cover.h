#pragma once
// Covers a polyhedron with overlapping convex pieces: every point inside the polyhedron lies strictly inside at least
// one piece. The pieces must overlap, because a field value of exactly 0 counts as void: samples in a common face of
// two pieces that merely touch would be 0.

#include <cstdint>
#include <vector>

#include "asset/bsp.h"
#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// A plane that bounds a convex piece. The piece lies behind the plane, and at least one face of the polyhedron lies in
/// it.
struct PieceSide {
  Plane plane;
  uint32_t number = 0;  ///< identifies the plane and its direction; the same in all pieces
  /// The material of those faces of the polyhedron that lie in `plane`. If these faces have several materials: the
  /// material with the largest area within this convex piece.
  uint32_t material = kNoMaterial;
};

using ConvexPiece = std::vector<PieceSide>;

struct CoverLimits {
  size_t cells = kMaxCells, pieces = 4096, features = 65536;
};

/// Returns the pieces: each as large as possible, none redundant. Errors: limit if the polyhedron is too intricate;
/// bad_input if it intersects itself so that a part is inside out.
Result<std::vector<ConvexPiece>> coverWithPieces(const Polyhedron& solid, const CoverLimits& limits = {});

}  // namespace sgm::asset
