#pragma once
// One flight through a streamed world, frame by frame, as an engine flies: through the public interface alone.

#include <sgm/sgm.h>

#include <functional>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "cli/flight_path.h"
#include "cli/frame_checker.h"

namespace sgm::cli {

struct FlightSettings {
  int32_t cell_units = 256;     ///< of the field
  double speed = 20;            ///< metres a second
  uint64_t frames = 600;        ///< of 1/60 s each
  uint64_t teleports = 0;       ///< spread evenly over the frames
  bool check = false;           ///< every frame's surface, and every 500th one whole
  bool paced = true;            ///< 60 frames a second; else as fast as they come
  double finest_distance = 24;  ///< metres within which a seen surface should be of level 0, as the world was told
  uint64_t frame_bytes = uint64_t{4} << 20;  ///< most bytes handed over in one frame
};

/// Thread CPU time in milliseconds.
struct FrameTimes {
  double p50 = 0, p99 = 0, max = 0;
};

struct FlightReport {
  uint64_t frames = 0, commits = 0;
  FrameReport worst;  ///< the largest counts of any frame; open edges and the like only with `check`
  uint64_t whole_checks = 0, whole_failures = 0;
  FrameTimes main_thread;              ///< of viewers, update, polling, and letting go of meshes
  double walkable_ms = -1;             ///< from the first update until every surface seen within 16 m is of level 0
  double seconds = 0;                  ///< on the wall, without planning of the path and checks where they are apart
  uint64_t seen = 0, seen_finest = 0;  ///< surfaces seen within finest_distance; those of level 0
  uint64_t frames_covered = 0, frames_seen = 0;  ///< frames all of whose seen surfaces are; frames that saw any
  uint64_t stale_before = 0, stale_after = 0;    ///< requests at teleports that nobody wants: at once, 2 frames later
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;  ///< at the end
};

/// What is drawn at the moment; for pictures.
struct DrawnMesh {
  std::shared_ptr<sgm_mesh> mesh;
  uint32_t seams = 0, coarser = 0;
};
using DrawnMeshes = std::map<std::tuple<int32_t, int32_t, int32_t, int32_t>, DrawnMesh>;

/// Called after every frame; false ends the flight.
using AfterFrame = std::function<bool(uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn)>;

/// Errors: those of the path, and of the world's calls.
Result<FlightReport> fly(sgm_world* world, sgm_field* field, FlightPath& path, const FlightSettings& settings,
                         const AfterFrame& after_frame);

}  // namespace sgm::cli
