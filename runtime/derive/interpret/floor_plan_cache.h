#pragma once
// Caches floor plans, so that equal storeys of a tower are laid out only once.

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "derive/interpret/budget.h"
#include "derive/layout/floor_plan.h"

namespace sgm::interpret {

/// Caches the floor plans of one cell. Laying out floor plans is the most expensive part of treemaps.
class FloorPlanCache {
 public:
  /// Returns the result of layOutFloor() for these inputs, from the cache if possible. Counts steps in the budget; if
  /// the budget fails, the result must not be used.
  FloorPlan layOut(const FloorPlanSizes& sizes, std::span<const double> areas, std::span<const RoomLink> links,
                   const Span& span, uint32_t activation, Budget& budget);

 private:
  std::map<std::vector<uint64_t>, FloorPlan> plans_;  ///< key of an entry: all inputs of layOutFloor()
};

}  // namespace sgm::interpret
