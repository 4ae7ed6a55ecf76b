#pragma once
// Operations on rectangles of the rooms, corridors and doors of a floor plan.

#include <algorithm>
#include <optional>
#include <vector>

#include "base/fixed.h"
#include "derive/layout/treemap.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm {

/// Distance by which a door's opening extends into the spaces that it joins, units.
inline constexpr int32_t kDoorReachUnits = static_cast<int32_t>(kDoorReach * kUnitsPerMetre);
/// All coordinates of a layout are multiples of this number of units, so that centres and halves are whole numbers.
inline constexpr int32_t kPlanStep = 2;

using Rects = std::vector<PlanRect>;

inline PlanRect grown(const PlanRect& r, int32_t by) { return {r.x0 - by, r.z0 - by, r.x1 + by, r.z1 + by}; }

inline PlanRect common(const PlanRect& a, const PlanRect& b) {
  return {std::max(a.x0, b.x0), std::max(a.z0, b.z0), std::min(a.x1, b.x1), std::min(a.z1, b.z1)};
}

/// Whether a square with edges of `width` units fits into the rectangle.
inline bool admits(const PlanRect& r, int32_t width) { return std::min(r.width(), r.depth()) >= width; }

/// Subtracts r from the union of the rectangles `from`; afterwards `from` contains all maximal rectangles of the
/// remaining area.
void takeAway(Rects& from, const PlanRect& r);

/// Keeps only the maximal rectangles that a square with edges of `width` units can reach from the first rectangle;
/// narrower space is unusable. Returns false if it removed a rectangle that is wide enough for the square, but
/// unreachable.
bool keepWalkable(Rects& room, int32_t width);

/// Returns the widest opening through the wall between spaces a and b. If the opening is wider than `width`, returns
/// only the middle part of that width. nullopt if a and b share no wall. wall: thickness in units.
std::optional<PlanRect> holeBetween(const Rects& a, const Rects& b, int32_t wall, int32_t width);

}  // namespace sgm
