#pragma once
// Rectangles of the rooms, corridors and doors of a floor plan.

#include <algorithm>
#include <optional>
#include <vector>

#include "base/fixed.h"
#include "derive/layout/treemap.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm {

/// How far the opening of a door extends into the spaces that it joins, in units.
inline constexpr int32_t kDoorReachUnits = static_cast<int32_t>(kDoorReach * kUnitsPerMetre);
/// The step of the layout in units, so that middles and halves are whole numbers.
inline constexpr int32_t kPlanStep = 2;

using Rects = std::vector<PlanRect>;

inline PlanRect grown(const PlanRect& r, int32_t by) { return {r.x0 - by, r.z0 - by, r.x1 + by, r.z1 + by}; }

inline PlanRect common(const PlanRect& a, const PlanRect& b) {
  return {std::max(a.x0, b.x0), std::max(a.z0, b.z0), std::min(a.x1, b.x1), std::min(a.z1, b.z1)};
}

/// True if a square with edges of `width` fits.
inline bool admits(const PlanRect& r, int32_t width) { return std::min(r.width(), r.depth()) >= width; }

/// Removes r; leaves all maximal rectangles of the rest.
void takeAway(Rects& from, const PlanRect& r);

/// Keeps the maximal rectangles from which a square of that width can be moved to the first one; narrower space is not
/// usable. Returns false if that removes any rectangle in which the square would fit.
bool keepWalkable(Rects& room, int32_t width);

/// The widest hole through a wall between the two, limited to `width` in its middle.
std::optional<PlanRect> holeBetween(const Rects& a, const Rects& b, int32_t wall, int32_t width);

}  // namespace sgm
