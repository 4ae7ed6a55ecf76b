#pragma once
// Writes data for the web page as JSON. Non-finite numbers become null. The functions are thread-safe and may throw
// std::bad_alloc.

#include <string>
#include <vector>

#include "tools/service/watch/service_state.h"
#include "tools/service/watch/watched_worlds.h"

namespace sgm::service {

/// The body of the answer to GET /api/v1/summary.
std::string summaryText(const ServiceState& state, const std::vector<WorldSample>& worlds);
/// The body of the answer to GET /api/v1/worlds/{name}/chunks.
std::string chunksText(const WorldMap& map);

}  // namespace sgm::service
