#pragma once
// Checks whether a world with given settings can be streamed.

#include <cstddef>

#include "base/result.h"
#include "stream/world_settings.h"
#include "world/world_field.h"

namespace sgm {

/// Checks the settings of a new world. threads: number of threads that mesh it. Errors: invalid_argument; limit
/// (mesh_bytes is too small, or the distances are too large: the message suggests values).
Result<void> checkWorld(const WorldField& field, const WorldSettings& settings, size_t threads);

/// Checks whether a field may replace the current field of a world. Errors: invalid_argument (another finest cell size,
/// or host fields that checkWorld() rejects); unsupported (a field without a grammar).
Result<void> checkSuccessor(const WorldField& next, const WorldField& current, const WorldSettings& settings);

}  // namespace sgm
