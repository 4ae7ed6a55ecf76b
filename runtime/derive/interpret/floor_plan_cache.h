#pragma once
// Floor plans that are laid out once for all storeys of a tower.

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "derive/interpret/budget.h"
#include "derive/layout/floor_plan.h"

namespace sgm::interpret {

/// Some of the floor plans of the cell so far.
class FloorPlanCache {
 public:
  /// layOutFloor(), or the known plan of the same inputs. Counts the work; if the budget fails, the result is
  /// meaningless.
  FloorPlan layOut(const FloorPlanSizes& sizes, std::span<const double> areas, std::span<const RoomLink> links,
                   const Span& span, uint32_t activation, Budget& budget);

 private:
  std::map<std::vector<uint64_t>, FloorPlan> plans_;  ///< by all inputs
};

}  // namespace sgm::interpret
