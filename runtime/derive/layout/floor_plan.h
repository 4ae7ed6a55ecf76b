#pragma once
// Floor plans: labelled rooms by a treemap, doors, and a corridor to rooms that no door reaches. After Marson and
// Musse, Automatic Real-Time Generation of Floor Plans Based on Squarified Treemaps Algorithm, Int. J. of Computer
// Games Technology 2010, 624817: rooms by squarified treemap, doors between those that may be connected, and a shortest
// path along inner walls to the rooms without access, which becomes the corridor.

#include <cstdint>
#include <span>
#include <vector>

#include "derive/layout/linked_rooms.h"
#include "derive/layout/treemap.h"

namespace sgm {

/// Metres: of walls where a treemap does not say.
inline constexpr double kTreemapWall = 0.2;

/// Units, above 0.
struct FloorPlanSizes {
  int32_t x = 0, z = 0;  ///< of the floor, outer walls included
  int32_t wall = 0;      ///< how thick all walls are
  int32_t door = 0;      ///< width of those that no link names
  int32_t corridor = 0;  ///< clear width
};

/// What is open of a room: rectangles that overlap where it is no rectangle, the largest first.
struct PlanRoom {
  PlanRect cell;  ///< its part of the treemap, to the middle of its walls
  std::vector<PlanRect> clear;
};

/// A hole through a wall, which reaches a little into what it joins.
struct PlanDoor {
  static constexpr size_t kCorridor = SIZE_MAX - 1, kOutside = SIZE_MAX, kNoLink = SIZE_MAX;
  PlanRect hole;
  size_t from = 0, to = 0;  ///< rooms, or those above
  size_t link = kNoLink;    ///< that asked for it
};

/// Of a room's outer wall, what has no entrance. side: in the order of front (+z), right (+x), back, left; low and
/// high: units along x or z.
struct PlanFacade {
  size_t room = 0;
  int side = 0;
  int32_t low = 0, high = 0;
};

/// All in units about the middle of the floor.
struct FloorPlan {
  bool fits = false;  ///< every room has space between its walls; otherwise nothing else is there
  std::vector<PlanRoom> rooms;
  std::vector<PlanRect> corridor;  ///< overlapping
  std::vector<PlanDoor> doors;     ///< the entrance first, where there is one
  std::vector<PlanFacade> facades;
  std::vector<size_t> closed;  ///< rooms that nothing leads to: no wall of theirs is wide enough
  uint64_t work = 0;           ///< as PlanWork counts it
  std::vector<size_t> unmet;   ///< links whose rooms share no wall that is wide enough
};

/// areas: above 0, one for each room; as exact as walls and the corridor leave them, which take their parts from what
/// they pass. Rooms that are linked come to lie beside each other where a squarified treemap of these areas allows it.
/// The entrance leads into room 0, or into the first that has an outer wall for it. Every room can be reached from
/// there but those in `closed`: by links; otherwise by a door from the entrance's room where they share a wall;
/// otherwise by a corridor from it; and by a door from any other room where no corridor fits. Where that takes more
/// than most_work, nothing is to be made of what comes out but how much that was.
FloorPlan layOutFloor(const FloorPlanSizes& sizes, std::span<const double> areas, std::span<const RoomLink> links,
                      uint64_t most_work = UINT64_MAX);

}  // namespace sgm
