#pragma once
// Repeats or removes zones (slabs) of a polyhedron along an axis.

#include <span>

#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// A zone: the interval of an axis between two planes perpendicular to the axis, in metres.
struct Stretch {
  double from = 0, to = 0;
};

inline constexpr size_t kMaxCopiedTriangles = 65536;

/// Repeats each zone `count` times (0 removes it), and moves the geometry behind each zone accordingly. The zones must
/// be in ascending order and disjoint. Errors: bad_input if the cross-sections at the two ends of a zone differ, so
/// that copies would not join; limit.
Result<Polyhedron> repeatAlong(const Polyhedron& solid, int axis, std::span<const Stretch> zones, size_t count);

}  // namespace sgm::asset
