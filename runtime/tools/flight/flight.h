#pragma once
// One flight through a streamed world, frame by frame, as an engine flies: through the public interface alone.

#include <functional>
#include <vector>

#include "tools/flight/flight_digger.h"
#include "tools/flight/flight_engine.h"
#include "tools/flight/flight_path.h"

namespace sgm::cli {

/// Metres around the viewer within which one can walk once what is seen is fine, and what is drawn has colliders: what
/// the world's collider_distance should be.
inline constexpr double kWalkableDistance = 16;

struct FlightSettings {
  int32_t cell_units = 256;     ///< of the field
  uint64_t seed = 0;            ///< of the digs
  double speed = 20;            ///< metres a second
  uint64_t frames = 600;        ///< of 1/60 s each
  uint64_t teleports = 0;       ///< spread evenly over the frames
  double edits = 0;             ///< digs a second of the path, up to 60
  bool check = false;           ///< every frame's surface, and every 500th one whole
  bool paced = true;            ///< 60 frames a second; else as fast as they come
  double finest_distance = 24;  ///< metres within which a seen surface should be of level 0, as the world was told
  uint64_t frame_bytes = uint64_t{4} << 20;  ///< most bytes handed over in one frame
  /// What else an engine does in a frame, so many seconds after the first; its time counts with the frame's. May be
  /// empty.
  std::function<Result<void>(double seconds)> each_frame;
};

struct FlightReport {
  uint64_t frames = 0, commits = 0;
  CheckedFrames checked;    ///< what is drawn at the end, at rest, too; empty without `check`
  Spread main_thread;       ///< thread CPU time of digging, viewers, update, polling, letting go of meshes, and what
                            ///< FlightSettings::each_frame does; ms
  double walkable_ms = -1;  ///< from the first update until every surface seen within kWalkableDistance is
                            ///< of level 0, and everything drawn there has a collider
  double seconds = 0;       ///< on the wall, without planning of the path and checks where they are apart
  uint64_t seen = 0, seen_finest = 0;            ///< surfaces seen within finest_distance; those of level 0
  uint64_t frames_covered = 0, frames_seen = 0;  ///< frames all of whose seen surfaces are; frames that saw any
  std::vector<uint64_t> work_at_teleports;       ///< requests that waited or were in work, of each
  std::vector<double> stale;  ///< the share of these that still do two frames later, where there were any; of paced
                              ///< flights alone
  DigReport digs;
  ColliderReport colliders;  ///< at the end, at rest
  uint64_t peak_collider_bytes = 0;
  uint64_t peak_handed_over = 0;                 ///< bytes of meshes in one frame
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;  ///< at the end, before it came to rest
};

struct FlightWatch {
  /// Told of every frame whose place is known before a paced flight begins, so that planning does not hold it up.
  std::function<void(uint64_t frame)> planned;
  /// Whether a picture of the frame is wanted. At the beginning and after leaps such a frame stands still until all
  /// surfaces seen within kWalkableDistance are drawn at level 0, or nothing is left to be made.
  std::function<bool(uint64_t frame)> pictured;
  /// Called after every frame; false ends the flight.
  std::function<bool(uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn)> flown;
};

/// Ends at rest: all is drawn that the last place wants. Errors: those of the path, and of the world's calls;
/// cancelled.
Result<FlightReport> fly(sgm_world* world, FlightPath& path, const FlightSettings& settings, const FlightWatch& watch);

}  // namespace sgm::cli
