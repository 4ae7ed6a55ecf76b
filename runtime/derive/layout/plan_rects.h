#pragma once
// Rectangles that rooms, corridors and doors of a floor plan are made of.

#include <algorithm>
#include <optional>
#include <vector>

#include "base/fixed.h"
#include "derive/layout/treemap.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm {

/// How far holes reach into what they join, units.
inline constexpr int32_t kDoorReachUnits = static_cast<int32_t>(kDoorReach * kUnitsPerMetre);
/// Units. Middles and halves of all that is laid out are whole numbers.
inline constexpr int32_t kPlanStep = 2;

using Rects = std::vector<PlanRect>;

inline PlanRect grown(const PlanRect& r, int32_t by) { return {r.x0 - by, r.z0 - by, r.x1 + by, r.z1 + by}; }

inline PlanRect common(const PlanRect& a, const PlanRect& b) {
  return {std::max(a.x0, b.x0), std::max(a.z0, b.z0), std::min(a.x1, b.x1), std::min(a.z1, b.z1)};
}

/// Whether a square with edges of `width` fits.
inline bool admits(const PlanRect& r, int32_t width) { return std::min(r.width(), r.depth()) >= width; }

/// What is left: all rectangles that no other one holds.
void takeAway(Rects& from, const PlanRect& r);

/// Leaves those between which a square of that width can be moved to the first; they are maximal. What is narrower is
/// nothing to stand in. False where that takes away any in which the square would fit.
bool keepWalkable(Rects& room, int32_t width);

/// The widest hole through a wall between the two: `width` of it, in its middle.
std::optional<PlanRect> holeBetween(const Rects& a, const Rects& b, int32_t wall, int32_t width);

}  // namespace sgm
