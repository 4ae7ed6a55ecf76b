#pragma once
// Writes the metrics in Prometheus' text format 0.0.4: base units, labels with a closed set of values, at most about
// 500 time series for each world.

#include <string>
#include <vector>

#include "tools/service/watch/service_state.h"
#include "tools/service/watch/watched_worlds.h"

namespace sgm::service {

/// Each metric family has HELP and TYPE. Names of worlds must be unique. Non-finite numbers are written as the format
/// requires. Thread-safe. Throws std::bad_alloc.
std::string metricsText(const ServiceState& state, const std::vector<WorldSample>& worlds);

}  // namespace sgm::service
