#pragma once
// Covers a polyhedron by overlapping convex pieces: every point inside it lies strictly inside one of them. If convex
// parts only touched, samples in their common face would be void, since a field is solid below zero.

#include <cstdint>
#include <vector>

#include "asset/bsp.h"
#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// A side of a piece: the plane of a face of the polyhedron, with the piece behind it.
struct PieceSide {
  Plane plane;
  uint32_t number = 0;  ///< of the plane and its side: the same in all pieces
  /// Of most of the face there: if two materials share a plane, the piece has the one of larger area.
  uint32_t material = kNoMaterial;
};

using ConvexPiece = std::vector<PieceSide>;

struct CoverLimits {
  size_t cells = kMostCells, pieces = 4096, features = 65536;
};

/// Returns pieces of maximal size, none of them redundant. Errors: limit (too intricate); bad_input if the polyhedron
/// intersects itself, so that its inside is out.
Result<std::vector<ConvexPiece>> coverWithPieces(const Polyhedron& solid, const CoverLimits& limits = {});

}  // namespace sgm::asset
