#pragma once
// Arranges rooms of a treemap so that rooms to be joined by a door share a wall.

#include <cstdint>
#include <span>
#include <vector>

#include "derive/layout/treemap.h"

namespace sgm {

/// A request to join two rooms by a door if they share a wall of sufficient width. width: units.
struct RoomLink {
  size_t a = 0, b = 0;
  int32_t width = 0;
};

/// The limit and the cost of a search, in visits of a room, about 0.1 us each. A search that exceeds the limit ends
/// with its best result so far.
struct PlanWork {
  uint64_t most = UINT64_MAX, done = 0;

  bool spent() const { return done > most; }
};

/// A squarified treemap of the areas. Its rows, and the rooms within them, are permuted so that a local search meets as
/// many links as it can, between walls of that thickness. Areas and shapes are the treemap's; it is unchanged if it
/// meets all links itself, or no step improves it.
std::vector<PlanRect> linkedRooms(const PlanRect& whole, std::span<const double> areas, std::span<const RoomLink> links,
                                  int32_t wall, int32_t step, PlanWork& work);

}  // namespace sgm
