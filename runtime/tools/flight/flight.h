#pragma once
// One flight through a streamed world, frame by frame as an engine would, through the public interface alone.

#include <functional>
#include <vector>

#include "tools/flight/flight_digger.h"
#include "tools/flight/flight_engine.h"
#include "tools/flight/flight_path.h"

namespace sgm::cli {

/// Metres around the viewer in which visible surfaces must be fine, and drawn chunks have colliders, for it to count as
/// walkable. The world's collider_distance should have this value.
inline constexpr double kWalkableDistance = 16;

struct FlightSettings {
  int32_t cell_units = 256;     ///< of the field
  uint64_t seed = 0;            ///< of the digs
  double speed = 20;            ///< metres a second
  uint64_t frames = 600;        ///< of 1/60 s each
  uint64_t teleports = 0;       ///< spread evenly over the frames
  double edits = 0;             ///< digs a second of the path, up to 60
  bool check = false;           ///< every frame's surface, and all chunks in every 500th frame
  bool paced = true;            ///< 60 frames a second; otherwise as fast as possible
  double finest_distance = 24;  ///< metres within which a visible surface should be of level 0, as set in the world
  uint64_t frame_bytes = uint64_t{4} << 20;  ///< maximum of bytes handed over in one frame
  /// An engine's other work in a frame, `seconds` after the first; counts as part of the frame's time. May be empty.
  std::function<Result<void>(double seconds)> each_frame;
};

struct FlightReport {
  uint64_t frames = 0, commits = 0;
  CheckedFrames checked;    ///< includes the last state, at rest; empty without `check`
  Spread main_thread;       ///< thread CPU time of digging, viewers, update, polling, releasing meshes, and of
                            ///< FlightSettings::each_frame; ms
  double walkable_ms = -1;  ///< from the first update until every visible surface within kWalkableDistance is of level
                            ///< 0, and everything drawn there has a collider
  double seconds = 0;       ///< wall time with checks, without planning of the path
  uint64_t seen = 0, seen_finest = 0;            ///< visible surfaces within finest_distance; those of level 0
  uint64_t frames_covered = 0, frames_seen = 0;  ///< frames with all visible surfaces at level 0; frames with a visible
                                                 ///< surface
  std::vector<uint64_t> work_at_teleports;       ///< requests waiting or in work at each teleport
  std::vector<double> stale;  ///< the share of these that still wait two frames later, if there were any; only in paced
                              ///< flights
  DigReport digs;
  ColliderReport colliders;  ///< at the end, at rest
  uint64_t peak_collider_bytes = 0;
  uint64_t peak_handed_over = 0;                 ///< bytes of meshes in one frame
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;  ///< at the end, before it came to rest
};

struct FlightWatch {
  /// Called in planning for every frame of a paced flight, before the flight begins.
  std::function<void(uint64_t frame)> planned;
  /// Whether a picture of the frame is wanted. At the beginning and after teleports, such a frame waits until all
  /// visible surfaces within kWalkableDistance are drawn at level 0, or no work is left.
  std::function<bool(uint64_t frame)> pictured;
  /// Called after every frame; false ends the flight.
  std::function<bool(uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn)> flown;
};

/// Ends at rest: everything for the last place is drawn. Errors: those of the path, and of the world's calls;
/// cancelled.
Result<FlightReport> fly(sgm_world* world, FlightPath& path, const FlightSettings& settings, const FlightWatch& watch);

}  // namespace sgm::cli
