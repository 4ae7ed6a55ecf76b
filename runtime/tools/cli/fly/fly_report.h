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
  uint64_t hash = 0;                                 ///< of level 0 around the end, at rest
  uint64_t runtime_peak_bytes = 0;                   ///< of all memory of the runtime
  uint64_t frame_bytes = 0;                          ///< the maximum for one frame
  uint64_t fields = 0;                               ///< with other parameters, passed to the world
  uint64_t fields_drawn = 0;                         ///< of these
  sgm_backend_info backend = SGM_BACKEND_INFO_INIT;  ///< at the end
  PictureLights lights;
  std::optional<sgm_world_measures> measures;  ///< at the end, if requested
  std::optional<Error> edits_lost;             ///< the journal does not hold all edits
};

/// by_distance: report of a second flight, with level 0 by distance alone.
Json toJson(const FlyOptions& options, const Flown& flown, const std::optional<FlightReport>& by_distance);
void print(const FlyOptions& options, const Flown& flown, const std::optional<FlightReport>& by_distance);

/// The first violated guarantee; nullopt if there is none.
std::optional<std::string> defectOf(const Flown& flown);

}  // namespace sgm::cli
