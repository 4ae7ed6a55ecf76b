#pragma once
// The report of `sgm fly`.

#include <optional>

#include "base/json.h"
#include "tools/cli/fly/commands.h"
#include "tools/cli/fly/fly_pictures.h"
#include "tools/flight/flight.h"
#include "tools/flight/fly_measures.h"

namespace sgm::cli {

struct Flown {
  FlightReport report;
  uint64_t hash = 0;                ///< hash of the level-0 chunks around the last position, after all work is done
  uint64_t runtime_peak_bytes = 0;  ///< peak of the memory that the runtime has allocated
  uint64_t frame_bytes = 0;         ///< maximum number of mesh bytes that one frame may receive
  uint64_t fields = 0;              ///< number of field updates with animated parameters that were passed to the world
  uint64_t fields_drawn = 0;        ///< number of field updates (see `fields`) that were drawn
  sgm_backend_info backend = SGM_BACKEND_INFO_INIT;  ///< state of the backend after the flight
  PictureLights lights;
  std::optional<sgm_world_measures> measures;  ///< measures of the chunks drawn at the end, if requested
  std::optional<Error> edits_lost;             ///< set if the journal does not contain all edits
};

/// Report as JSON. by_distance: report of a second flight for comparison, in which the distance alone selects level 0.
Json toJson(const FlyOptions& options, const Flown& flown, const std::optional<FlightReport>& by_distance);
void print(const FlyOptions& options, const Flown& flown, const std::optional<FlightReport>& by_distance);

/// Describes the first guarantee of the runtime that was violated during the flight; nullopt if all guarantees held.
std::optional<std::string> defectOf(const Flown& flown);

}  // namespace sgm::cli
