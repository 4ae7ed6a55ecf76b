#pragma once
// What `sgm fly --measure` says of the chunks that were streamed.

#include <sgm/sgm.h>

#include <optional>
#include <string>

#include "base/json.h"

namespace sgm::cli {

Json toJson(const sgm_world_measures& measures);
void print(const sgm_world_measures& measures);

/// What is wrong with the chunks that were made; nothing where none is.
std::optional<std::string> defectOf(const sgm_world_measures& measures);

}  // namespace sgm::cli
