#pragma once
// What `sgm fly` says of a flight.

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
  uint64_t runtime_peak_bytes = 0;                   ///< of all that the runtime held at one time
  uint64_t frame_bytes = 0;                          ///< the most that could be handed over in one frame
  uint64_t fields = 0;                               ///< with other parameters, that the world was handed
  uint64_t fields_drawn = 0;                         ///< of them
  sgm_backend_info backend = SGM_BACKEND_INFO_INIT;  ///< at the end
  PictureLights lights;
  std::optional<sgm_world_measures> measures;  ///< at the end, where they were asked for
  std::optional<Error> edits_lost;             ///< the journal does not hold all edits
};

/// by_distance: of a second flight, with level 0 by distance alone.
Json toJson(const FlyOptions& options, const Flown& flown, const std::optional<FlightReport>& by_distance);
void print(const FlyOptions& options, const Flown& flown, const std::optional<FlightReport>& by_distance);

/// What was not as it is promised; nothing where all was.
std::optional<std::string> defectOf(const Flown& flown);

}  // namespace sgm::cli
