#pragma once
// One flight through a streamed world, frame by frame as an engine would run it, through the public interface alone.

#include <functional>
#include <vector>

#include "tools/flight/flight_digger.h"
#include "tools/flight/flight_engine.h"
#include "tools/flight/flight_path.h"

namespace sgm::cli {

/// Radius in metres around the viewer. The surroundings count as walkable if all visible surfaces within it are of
/// level 0 and all drawn chunks there have colliders. The world's collider_distance should have this value.
inline constexpr double kWalkableDistance = 16;

struct FlightSettings {
  int32_t cell_units = 256;  ///< edge of the field's finest grid cells, in units
  uint64_t seed = 0;         ///< seed of the random digs
  double speed = 20;         ///< metres a second
  uint64_t frames = 600;     ///< number of frames, each 1/60 s long
  uint64_t teleports = 0;    ///< number of teleports, spread evenly over the frames
  double edits = 0;          ///< digs per second of the path, up to 60
  bool check = false;        ///< checks every frame's changes of the surface, and all chunks in every 500th frame
  bool paced = true;         ///< runs at 60 frames a second; otherwise as fast as possible
  /// Distance in metres within which visible surfaces should be of level 0; the world has the same setting.
  double finest_distance = 24;
  uint64_t frame_bytes = uint64_t{4} << 20;  ///< maximum number of mesh bytes handed over in one frame
  /// Stands for an engine's other work in a frame, `seconds` after the first frame; its time counts as part of the
  /// frame's time. May be empty.
  std::function<Result<void>(double seconds)> each_frame;
};

struct FlightReport {
  uint64_t frames = 0, commits = 0;
  CheckedFrames checked;  ///< includes the last state, when all work is done; empty without `check`
  /// Thread CPU time of each frame in ms: digging, setting viewers, updating, polling, releasing meshes, and
  /// FlightSettings::each_frame.
  Spread main_thread;
  /// Wall time from the first update until the surroundings are walkable (kWalkableDistance); -1 if they never were.
  double walkable_ms = -1;
  double seconds = 0;  ///< wall time including checks, without the planning of the path
  /// Number of visible surfaces within finest_distance, and how many of these were of level 0, over all frames.
  uint64_t seen = 0, seen_finest = 0;
  /// Number of frames in which all visible surfaces were of level 0; number of frames with a visible surface.
  uint64_t frames_covered = 0, frames_seen = 0;
  std::vector<uint64_t> work_at_teleports;  ///< number of requests that wait or are being processed at each teleport
  /// Share of these requests that still wait two frames later, for each teleport with such requests; only in paced
  /// flights.
  std::vector<double> stale;
  DigReport digs;
  ColliderReport colliders;  ///< at the end, when all work is done
  uint64_t peak_collider_bytes = 0;
  uint64_t peak_handed_over = 0;                 ///< maximum number of bytes of meshes received in one frame
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;  ///< after the last frame, before the remaining work was done
};

struct FlightWatch {
  /// Called for every frame of a paced flight while the path is planned, before the flight begins.
  std::function<void(uint64_t frame)> planned;
  /// Returns whether a picture of the frame is wanted. At the beginning and after teleports, such a frame waits until
  /// all visible surfaces within kWalkableDistance are drawn at level 0, or no work is left.
  std::function<bool(uint64_t frame)> pictured;
  /// Called after every frame; returns false to end the flight.
  std::function<bool(uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn)> flown;
};

/// Runs the flight, then waits until everything around its last place is drawn. Errors: those of the path, and of the
/// world's functions; cancelled.
Result<FlightReport> fly(sgm_world* world, FlightPath& path, const FlightSettings& settings, const FlightWatch& watch);

}  // namespace sgm::cli
