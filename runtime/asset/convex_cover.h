#pragma once
// A polyhedron as a union of convex pieces that overlap: every point inside it lies strictly inside one of them. Convex
// parts that only touch would leave the samples in their common face void, since solid is where a field is below zero.

#include <cstdint>
#include <vector>

#include "asset/bsp.h"
#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// What a piece lies behind: the plane of a face of the polyhedron's.
struct PieceSide {
  Plane plane;
  uint32_t number = 0;  ///< of the plane with its side: the same in all pieces
  /// Of most of the face there: where two materials lie side by side in one plane, a piece has the larger one's.
  uint32_t material = kNoMaterial;
};

using ConvexPiece = std::vector<PieceSide>;

struct CoverLimits {
  size_t cells = kMostCells, pieces = 4096, features = 65536;
};

/// Pieces as large as they can be, none of which the others make superfluous. Errors: limit (too intricate);
/// bad_input, where it runs through itself, so that its inside is out.
Result<std::vector<ConvexPiece>> coverWithPieces(const Polyhedron& solid, const CoverLimits& limits = {});

}  // namespace sgm::asset
