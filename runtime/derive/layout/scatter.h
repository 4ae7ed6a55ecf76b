#pragma once
// Point sets that do not depend on the order of visits.

#include <optional>
#include <vector>

#include "derive/frame.h"
#include "derive/lattice.h"

namespace sgm {

/// A point relative to the low corner of its cell, in units, and the key of all its draws.
struct LatticePoint {
  Int3 offset;
  PathKey key;
};

/// The points in a cell of the layer's infinite set in which no two are nearer than `radius` units (at least 1): one
/// jittered candidate per cube of that edge, kept if its hash exceeds those of all candidates within the radius (the
/// second rule of Matern). Depends on nothing farther than the radius. `key` identifies the set, the same in all cells.
/// nullopt if it would have to examine more than `limit` candidates.
std::optional<std::vector<LatticePoint>> poissonInCell(const Lattice& lattice, Int3 cell, PathKey key, int32_t radius,
                                                       size_t limit);

/// `count` points spread over the fraction `up` (0..1, from the top) of the sphere of the given radius: strips of equal
/// area, turned by the golden angle, jittered by the key.
std::vector<Vec3> scatterOnShell(PathKey key, size_t count, double radius, double up);
/// Independent uniform points in a centred box with the given edges, or on the disc in the plane y = 0.
std::vector<Vec3> scatterInBox(PathKey key, size_t count, Vec3 edges);
std::vector<Vec3> scatterOnDisc(PathKey key, size_t count, double radius);

/// The indices of the points whose hash exceeds the hashes of all points nearer than `radius`.
std::vector<size_t> thinned(PathKey key, const std::vector<Vec3>& points, double radius);

}  // namespace sgm
