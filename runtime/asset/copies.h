#pragma once
// Repeats or removes zones of a polyhedron along an axis.

#include <span>

#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// The interval of an axis between two planes perpendicular to it.
struct Stretch {
  double from = 0, to = 0;
};

inline constexpr size_t kMaxCopiedTriangles = 65536;

/// Repeats each zone `count` times (0: removes it), and moves everything behind a zone accordingly. The zones must be
/// in order and disjoint. Errors: bad_input if the sections at the two ends of a zone differ, so that the copies would
/// not join; limit.
Result<Polyhedron> repeatAlong(const Polyhedron& solid, int axis, std::span<const Stretch> zones, size_t count);

}  // namespace sgm::asset
