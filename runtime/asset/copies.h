#pragma once
// Zones of a polyhedron that are repeated along an axis, or taken out.

#include <span>

#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// Between two planes across an axis.
struct Stretch {
  double from = 0, to = 0;
};

inline constexpr size_t kMostCopiedTriangles = 65536;

/// Each zone `count` times, one after another, and what lies behind moved on; zones in order, apart from each other.
/// Errors: bad_input, where the section at the one end of a zone is another than at its other end, so that the copies
/// would not join; limit.
Result<Polyhedron> repeatAlong(const Polyhedron& solid, int axis, std::span<const Stretch> zones, size_t count);

}  // namespace sgm::asset
