#pragma once
// What Prometheus reads: text of its format 0.0.4. Base units, labels of closed sets, at most some 500 series a world.

#include <string>
#include <vector>

#include "tools/service/watch/service_state.h"
#include "tools/service/watch/watched_worlds.h"

namespace sgm::service {

/// Each family has HELP and TYPE. Names of worlds are to differ. Numbers that are not finite are written as the format
/// has them. Any thread. Throws std::bad_alloc.
std::string metricsText(const ServiceState& state, const std::vector<WorldSample>& worlds);

}  // namespace sgm::service
