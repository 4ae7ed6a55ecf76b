#pragma once
// Runs one flight through a streamed world, frame by frame as an engine would, using only the public interface.

#include <functional>
#include <vector>

#include "tools/flight/flight_digger.h"
#include "tools/flight/flight_engine.h"
#include "tools/flight/flight_path.h"

namespace sgm::cli {

/// Radius around the viewer, in metres. The surroundings count as walkable if all visible surfaces within this radius
/// are drawn at level 0 and all drawn chunks there have colliders. The world's collider_distance should be this value.
inline constexpr double kWalkableDistance = 16;

struct FlightSettings {
  int32_t cell_units = 256;  ///< edge of the field's finest grid cells, in units
  uint64_t seed = 0;         ///< seed of the random digs (edits of the world)
  double speed = 20;         ///< metres a second
  uint64_t frames = 600;     ///< number of frames, each 1/60 s long
  uint64_t teleports = 0;    ///< number of teleports, spread evenly over the frames
  double edits = 0;          ///< digs (edits of the world) per second of the path, at most 60
  bool check = false;        ///< true: checks the changes of the surface in every frame, and all chunks in every 500th
                             ///< frame
  bool paced = true;         ///< true: runs at 60 frames per second; false: as fast as possible
  /// Distance in metres within which visible surfaces should be drawn at level 0; the world's finest_distance must not
  /// be smaller.
  double finest_distance = 24;
  uint64_t frame_bytes = uint64_t{4} << 20;  ///< maximum number of mesh bytes that the world delivers in one frame
  /// Called in each frame, `seconds` after the first frame, in place of an engine's other work; its duration counts as
  /// frame time. May be empty.
  std::function<Result<void>(double seconds)> each_frame;
};

struct FlightReport {
  uint64_t frames = 0, commits = 0;
  /// Results of all checks, including the final state, when all work is done; empty without `check`.
  CheckedFrames checked;
  /// CPU time of the calling thread in each frame, in ms: digging, setting viewers, updating, polling, releasing
  /// meshes, and FlightSettings::each_frame.
  Spread main_thread;
  /// Wall time from the first update until the surroundings were walkable (kWalkableDistance); -1 if they never were.
  double walkable_ms = -1;
  double seconds = 0;  ///< wall time of the flight, including the checks, but not the planning of the path
  /// Over all frames: number of rays that hit a surface within finest_distance, and number of these hits where the
  /// surface was drawn at level 0.
  uint64_t seen = 0, seen_finest = 0;
  /// Number of frames in which all surfaces hit by rays were drawn at level 0; number of frames in which rays hit a
  /// surface.
  uint64_t frames_covered = 0, frames_seen = 0;
  /// For each teleport: number of chunk requests that were waiting or in progress at that time.
  std::vector<uint64_t> work_at_teleports;
  /// For each teleport with pending requests: share of these requests that are still pending two frames later. Only in
  /// paced flights.
  std::vector<double> stale;
  DigReport digs;
  ColliderReport colliders;  ///< state of the colliders at the end, when all work is done
  uint64_t peak_collider_bytes = 0;
  uint64_t peak_handed_over = 0;  ///< maximum number of mesh bytes received in one frame
  /// Statistics after the last frame, before the remaining work was done.
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
};

struct FlightWatch {
  /// Called each time that a frame has been planned. Only for paced flights: their whole path is planned before they
  /// begin.
  std::function<void(uint64_t frame)> planned;
  /// Returns whether a picture of the frame is wanted. At the beginning and after teleports, the flight pauses at a
  /// wanted frame until all visible surfaces within kWalkableDistance are drawn at level 0, or no work is left.
  std::function<bool(uint64_t frame)> pictured;
  /// Called after every frame; returns false to end the flight.
  std::function<bool(uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn)> flown;
};

/// Runs the flight, then waits until everything around the last position is drawn. Errors: those of the path and of the
/// world's functions; cancelled if FlightWatch::flown returns false.
Result<FlightReport> fly(sgm_world* world, FlightPath& path, const FlightSettings& settings, const FlightWatch& watch);

}  // namespace sgm::cli
