#pragma once
// The text for Prometheus, format 0.0.4: base units, labels of closed sets, at most about 500 series a world.

#include <string>
#include <vector>

#include "tools/service/watch/service_state.h"
#include "tools/service/watch/watched_worlds.h"

namespace sgm::service {

/// Each family has HELP and TYPE. Names of worlds must be unique. Non-finite numbers are written as the format
/// requires. Thread-safe. Throws std::bad_alloc.
std::string metricsText(const ServiceState& state, const std::vector<WorldSample>& worlds);

}  // namespace sgm::service
