#pragma once
// Floor plans: labelled rooms by a treemap, doors, and a corridor to rooms without a door. After Marson and Musse,
// Automatic Real-Time Generation of Floor Plans Based on Squarified Treemaps Algorithm, Int. J. of Computer Games
// Technology 2010, 624817: rooms by squarified treemap, doors between rooms that may be connected, and a shortest path
// along inner walls to the rooms without access, which becomes the corridor.

#include <cstdint>
#include <span>
#include <vector>

#include "derive/layout/linked_rooms.h"
#include "derive/layout/treemap.h"

namespace sgm {

/// Metres: default thickness of walls in a treemap.
inline constexpr double kTreemapWall = 0.2;

/// Units, above 0.
struct FloorPlanSizes {
  int32_t x = 0, z = 0;  ///< of the floor, including outer walls
  int32_t wall = 0;      ///< thickness of all walls
  int32_t door = 0;      ///< width of doors without a link
  int32_t corridor = 0;  ///< clear width
};

/// The open space of a room: rectangles, overlapping if the room is not a rectangle, the largest first.
struct PlanRoom {
  PlanRect cell;  ///< its part of the treemap, to the middle of its walls
  std::vector<PlanRect> clear;
};

/// A hole through a wall, which extends slightly into the adjacent spaces.
struct PlanDoor {
  static constexpr size_t kCorridor = SIZE_MAX - 1, kOutside = SIZE_MAX, kNoLink = SIZE_MAX;
  PlanRect hole;
  size_t from = 0, to = 0;  ///< rooms, or the constants above
  size_t link = kNoLink;    ///< that requested it
};

/// The part of a room's outer wall without an entrance. side: in the order front (+z), right (+x), back, left; low and
/// high: units along x or z.
struct PlanFacade {
  size_t room = 0;
  int side = 0;
  int32_t low = 0, high = 0;
};

/// All in units about the middle of the floor.
struct FloorPlan {
  bool fits = false;  ///< every room has space between its walls; otherwise all else is empty
  std::vector<PlanRoom> rooms;
  std::vector<PlanRect> corridor;  ///< overlapping
  std::vector<PlanDoor> doors;     ///< the entrance first, if there is one
  std::vector<PlanFacade> facades;
  std::vector<size_t> closed;  ///< inaccessible rooms: no wall of theirs is wide enough
  uint64_t work = 0;           ///< as counted by PlanWork
  std::vector<size_t> unmet;   ///< links whose rooms share no wall of sufficient width
};

/// areas: above 0, one per room. Room sizes are exact except for walls and the corridor, which take space from the
/// rooms that they pass. Linked rooms are placed side by side if a squarified treemap of these areas allows it. The
/// entrance leads into room 0, or into the first room with a suitable outer wall. Every room except those in `closed`
/// can be reached from there: by links; otherwise by a door from the entrance's room if they share a wall; otherwise by
/// a corridor from it; or by a door from any other room if no corridor fits. If that takes more than most_work, only
/// `work` of the result is meaningful.
FloorPlan layOutFloor(const FloorPlanSizes& sizes, std::span<const double> areas, std::span<const RoomLink> links,
                      uint64_t most_work = UINT64_MAX);

}  // namespace sgm
