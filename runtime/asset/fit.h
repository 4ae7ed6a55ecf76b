#pragma once
// An asset in the size of a scope: zones that stretch, zones that are repeated, all else stiff.

#include <span>
#include <string>
#include <vector>

#include "asset/polyhedron.h"
#include "base/result.h"

namespace sgm::asset {

struct FitZone {
  int axis = 0;
  bool repeats = false;     ///< otherwise it stretches
  double from = 0, to = 0;  ///< metres from the low end of the asset's box
};

/// The asset with its box about the origin and of this size, metres; its angles kept.
///
/// Along an axis without zones all of it stretches alike. With zones, what lies outside of them is stiff; those that
/// stretch share what is to be gained or lost in proportion to their lengths. Zones that repeat are copied as often as
/// comes nearest to the size, all of one axis the same number of times: by themselves once at least, and then it is the
/// copies that stretch; beside zones that stretch they may go, and are stiff. Where the count that comes nearest is
/// impossible, one fewer is tried.
///
/// Errors: bad_input, with what is wrong and what would be right: zones outside of the asset or upon each other, a
/// zone with another section at its end than at its beginning, a size that it cannot have; limit.
Result<Polyhedron> fitInto(const Polyhedron& asset, Point size, std::span<const FitZone> zones);

}  // namespace sgm::asset
