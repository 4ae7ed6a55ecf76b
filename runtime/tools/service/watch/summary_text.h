#pragma once
// The page's data as JSON. Non-finite numbers are null. Thread-safe. The functions throw std::bad_alloc.

#include <string>
#include <vector>

#include "tools/service/watch/service_state.h"
#include "tools/service/watch/watched_worlds.h"

namespace sgm::service {

/// GET /api/v1/summary.
std::string summaryText(const ServiceState& state, const std::vector<WorldSample>& worlds);
/// GET /api/v1/worlds/{name}/chunks.
std::string chunksText(const WorldMap& map);

}  // namespace sgm::service
