#pragma once
// Floor plans: labelled rooms by a treemap, doors, and a corridor to rooms without a door. After Marson and Musse,
// Automatic Real-Time Generation of Floor Plans Based on Squarified Treemaps Algorithm, Int. J. of Computer Games
// Technology 2010, 624817: rooms by squarified treemap, doors between rooms that may be connected, and a corridor,
// which is a shortest path along inner walls to the rooms without access.

#include <cstdint>
#include <span>
#include <vector>

#include "derive/layout/linked_rooms.h"
#include "derive/layout/treemap.h"

namespace sgm {

/// Default thickness of walls in a treemap, metres.
inline constexpr double kTreemapWall = 0.2;

/// The measures of a floor plan in units; all above 0.
struct FloorPlanSizes {
  int32_t x = 0, z = 0;  ///< edges of the floor, including outer walls
  int32_t wall = 0;      ///< thickness of all walls, inner and outer
  int32_t door = 0;      ///< width of doors that are not requested by a link
  int32_t corridor = 0;  ///< clear width of the corridor
};

/// The open space of a room: rectangles, largest first; several overlapping ones if the room is not a rectangle.
struct PlanRoom {
  PlanRect cell;  ///< the room's rectangle in the treemap, which extends to the centre lines of its walls
  std::vector<PlanRect> clear;
};

/// An opening in a wall; it extends slightly into the spaces on both sides.
struct PlanDoor {
  static constexpr size_t kCorridor = SIZE_MAX - 1, kOutside = SIZE_MAX, kNoLink = SIZE_MAX;
  PlanRect hole;
  size_t from = 0, to = 0;  ///< indices of the rooms that the door connects, or kCorridor or kOutside
  size_t link = kNoLink;    ///< index of the link that requested the door; kNoLink: none
};

/// A stretch of a room's outer wall without an entrance. side: 0 front (+z), 1 right (+x), 2 back, 3 left. low, high:
/// ends of the stretch, in units along x or z.
struct PlanFacade {
  size_t room = 0;
  int side = 0;
  int32_t low = 0, high = 0;
};

/// A finished floor plan. Positions are in units, relative to the centre of the floor.
struct FloorPlan {
  bool fits = false;  ///< true: every room has open space between its walls; false: all other members are empty
  std::vector<PlanRoom> rooms;
  std::vector<PlanRect> corridor;  ///< open space of the corridor: rectangles, which may overlap
  std::vector<PlanDoor> doors;     ///< the entrance comes first, if there is one
  std::vector<PlanFacade> facades;
  std::vector<size_t> closed;  ///< indices of inaccessible rooms, none of whose walls is wide enough for a door
  uint64_t work = 0;           ///< amount of work, as counted by PlanWork
  std::vector<size_t> unmet;   ///< indices of links whose rooms share no wall of sufficient width
};

/// Lays out a floor. areas: relative areas of the rooms, above 0. Each room gets its share of the floor, except that
/// walls and the corridor take space from the rooms that they pass. Linked rooms are placed side by side if a
/// squarified treemap of these areas allows it. The entrance leads into room 0, or into the first room with a suitable
/// outer wall. Every room except those in `closed` can be reached from there: by links; otherwise by a door from the
/// entrance's room if they share a wall; otherwise by a corridor from it; or by a door from any other room if no
/// corridor fits. If the work exceeds max_work, only `work` of the result is meaningful.
FloorPlan layOutFloor(const FloorPlanSizes& sizes, std::span<const double> areas, std::span<const RoomLink> links,
                      uint64_t max_work = UINT64_MAX);

}  // namespace sgm
