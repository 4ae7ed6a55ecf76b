#pragma once
// The C interface's backends as requests for ours.

#include <optional>

#include "backend/backend.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Nothing for a number that is no sgm_backend.
std::optional<BackendRequest> requestOf(sgm_backend backend);

}  // namespace sgm::api
