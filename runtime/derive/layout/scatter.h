#pragma once
// Point sets that do not depend on the order in which points or cells are visited.

#include <optional>
#include <vector>

#include "derive/frame.h"
#include "derive/lattice.h"

namespace sgm {

/// A point of a set that covers the whole lattice: its offset from the low corner of its cell, in units, and the key
/// for its random draws.
struct LatticePoint {
  Int3 offset;
  PathKey key;
};

/// Returns the points in one cell of an infinite set in which no two points are closer than `radius` units (at least
/// 1). The set has one jittered candidate in each cube whose edge is the radius; a candidate is kept if its hash
/// exceeds those of all candidates within the radius (Matern's second thinning rule). Depends on nothing farther away
/// than the radius. key: identifies the set; the same in all cells. nullopt if more than `limit` candidates would have
/// to be examined.
std::optional<std::vector<LatticePoint>> poissonInCell(const Lattice& lattice, Int3 cell, PathKey key, int32_t radius,
                                                       size_t limit);

/// Returns `count` points on the top part of a sphere, which is the fraction `up` (0..1) of its area: one point in each
/// of `count` horizontal strips of equal area. From strip to strip the point is rotated by the golden angle. `key`
/// draws the jitter.
std::vector<Vec3> scatterOnShell(PathKey key, size_t count, double radius, double up);
/// scatterInBox() returns independent uniform points in a box around the origin with the given edges; scatterOnDisc(),
/// on a disc around the origin in the plane y = 0.
std::vector<Vec3> scatterInBox(PathKey key, size_t count, Vec3 edges);
std::vector<Vec3> scatterOnDisc(PathKey key, size_t count, double radius);

/// Returns the indices of the points whose hash exceeds the hashes of all points closer than `radius`.
std::vector<size_t> thinned(PathKey key, const std::vector<Vec3>& points, double radius);

}  // namespace sgm
