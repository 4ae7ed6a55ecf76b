#pragma once
// The part of the report of `sgm fly --measure` about the measures of the streamed chunks.

#include <sgm/sgm.h>

#include <optional>
#include <string>

#include "base/json.h"

namespace sgm::cli {

Json toJson(const sgm_world_measures& measures);
void print(const sgm_world_measures& measures);

/// Describes the defects of the meshed chunks; nullopt if there are none.
std::optional<std::string> defectOf(const sgm_world_measures& measures);

}  // namespace sgm::cli
