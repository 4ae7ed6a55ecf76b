#pragma once
// Writes the metrics in Prometheus's text format 0.0.4. Values are in base units, labels have few possible values, and
// each world has at most about 500 time series.

#include <string>
#include <vector>

#include "tools/service/watch/service_state.h"
#include "tools/service/watch/watched_worlds.h"

namespace sgm::service {

/// The metrics as text. Each family has a HELP and a TYPE line. Contract: the worlds' names are unique. Non-finite
/// numbers are written as the format requires. Thread-safe. Throws std::bad_alloc.
std::string metricsText(const ServiceState& state, const std::vector<WorldSample>& worlds);

}  // namespace sgm::service
