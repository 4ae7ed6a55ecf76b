#pragma once
// Covers a polyhedron by overlapping convex pieces: every point inside it lies strictly inside one of them. The pieces
// must overlap, because a field is solid only below 0: samples in a common face of two pieces that merely touch would
// be 0, and so void.

#include <cstdint>
#include <vector>

#include "asset/bsp.h"
#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// A side of a piece: the plane of one of the polyhedron's faces. The piece lies behind it.
struct PieceSide {
  Plane plane;
  uint32_t number = 0;  ///< identifies the plane and its direction: the same number in all pieces
  /// The material of the polyhedron's face in that plane. If faces with two materials share the plane, the material of
  /// the larger area within the piece.
  uint32_t material = kNoMaterial;
};

using ConvexPiece = std::vector<PieceSide>;

struct CoverLimits {
  size_t cells = kMaxCells, pieces = 4096, features = 65536;
};

/// Returns pieces of maximal size, none of them redundant. Errors: limit if the polyhedron is too intricate; bad_input
/// if it intersects itself so that its inside faces out.
Result<std::vector<ConvexPiece>> coverWithPieces(const Polyhedron& solid, const CoverLimits& limits = {});

}  // namespace sgm::asset
