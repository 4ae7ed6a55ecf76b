#pragma once
// Fits an asset (a mesh) to the size of a scope: some zones stretch, some are repeated, and the rest is stiff.

#include <span>
#include <string>
#include <vector>

#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

/// An interval of an axis within which the asset may change its length. Outside zones the asset is stiff.
struct FitZone {
  int axis = 0;
  bool repeats = false;     ///< true: the zone is repeated, as often as fits; false: the zone is stretched
  double from = 0, to = 0;  ///< distance from the low end of the asset's bounding box, in metres
};

/// Resizes an asset. The result keeps the asset's angles, and its bounding box has the given size in metres, centred on
/// the origin.
///
/// Along an axis without zones, the whole asset stretches evenly. With zones, the parts outside them are stiff, and the
/// stretching zones share the change of length in proportion to their lengths. All repeating zones of an axis get the
/// same number of copies: the number that comes nearest to the size. If the axis has no stretching zones, there is at
/// least one copy, and the copies stretch. If it has some, the number may be 0, and the copies are stiff. If the
/// nearest number is impossible, one copy fewer is tried.
///
/// Errors: bad_input, with the problem and its remedy, for zones outside the asset or overlapping, for a zone whose
/// cross-sections at its two ends differ, and for a size that the asset cannot have; limit.
Result<Polyhedron> fitInto(const Polyhedron& asset, Point size, std::span<const FitZone> zones);

}  // namespace sgm::asset
