#pragma once
// Arranges the rooms of a treemap. Two rooms that are to be connected by a door get a common wall, if possible.

#include <cstdint>
#include <span>
#include <vector>

#include "derive/layout/treemap.h"

namespace sgm {

/// A request to connect rooms a and b by a door, if they share a wall of sufficient width. width: width of the door in
/// units.
struct RoomLink {
  size_t a = 0, b = 0;
  int32_t width = 0;
};

/// Limits and counts the work of a search, in visits of a room (about 0.1 us each). A search that exceeds the limit
/// ends with its best result so far.
struct PlanWork {
  uint64_t most = UINT64_MAX, done = 0;

  bool spent() const { return done > most; }
};

/// Computes a squarified treemap of the areas. A local search then permutes its rows, and the rooms within rows, so
/// that as many links as possible are satisfied. wall: thickness of walls in units. The areas and shapes of the rooms
/// do not change. If the treemap already satisfies all links, or the search finds no improvement, the treemap is
/// returned as it is.
std::vector<PlanRect> linkedRooms(const PlanRect& whole, std::span<const double> areas, std::span<const RoomLink> links,
                                  int32_t wall, int32_t step, PlanWork& work);

}  // namespace sgm
