#pragma once
// Fits an asset to the size of a scope: some zones stretch, some are repeated, and the rest is stiff.

#include <span>
#include <string>
#include <vector>

#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// An interval of an axis that may change its length. The rest of the asset is stiff.
struct FitZone {
  int axis = 0;
  bool repeats = false;     ///< true: the zone is repeated; false: it stretches
  double from = 0, to = 0;  ///< metres from the low end of the asset's bounding box
};

/// Resizes an asset. The result keeps the asset's angles, and its bounding box has the given size, in metres, centred
/// on the origin.
///
/// Along an axis without zones the whole asset stretches evenly. With zones, the parts outside them are stiff, and the
/// stretching zones share the change in proportion to their lengths. All repeating zones of an axis get the same number
/// of copies, the one that comes nearest to the size. Without stretching zones there is at least one copy, and the
/// copies stretch; beside stretching zones the number may be 0, and the copies are stiff. If the nearest number is
/// impossible, one fewer is tried.
///
/// Errors: bad_input, with the problem and its remedy: zones outside the asset or overlapping, a zone whose sections at
/// its two ends differ, a size that the asset cannot have; limit.
Result<Polyhedron> fitInto(const Polyhedron& asset, Point size, std::span<const FitZone> zones);

}  // namespace sgm::asset
