#pragma once
// Rooms of a treemap so that those which a door should join share a wall.

#include <cstdint>
#include <span>
#include <vector>

#include "derive/layout/treemap.h"

namespace sgm {

/// Rooms that a door joins where they share a wall that is wide enough. width: units.
struct RoomLink {
  size_t a = 0, b = 0;
  int32_t width = 0;
};

/// What a search may cost and has cost, in looks at a room, about 0.1 us each. Once it has cost more it ends, with
/// whatever it has.
struct PlanWork {
  uint64_t most = UINT64_MAX, done = 0;

  bool spent() const { return done > most; }
};

/// A squarified treemap of the areas whose rows, and rooms within them, have changed places so that as many links as a
/// search by steps finds are met, between walls of that thickness. Areas and shapes are the treemap's; where it meets
/// all links itself, or no step is better, it is as it was.
std::vector<PlanRect> linkedRooms(const PlanRect& whole, std::span<const double> areas, std::span<const RoomLink> links,
                                  int32_t wall, int32_t step, PlanWork& work);

}  // namespace sgm
