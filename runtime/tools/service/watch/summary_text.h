#pragma once
// What the page shows, as JSON. Numbers that are not finite are null. Any thread. Throw std::bad_alloc.

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
