#pragma once
// Opens this machine's backends whose times the paper's tables compare, stage by stage.

#include <string>
#include <vector>

#include "tools/paper/stage.h"

namespace sgm::cli {

/// Opens the sequential backend first, then one backend for each name, or all backends if there are no names.
/// Unavailable backends, and software devices that are not named, are included with the reason why they are not
/// measured. threads: number of CPU threads; 0: one for each processor.
Result<std::vector<BackendRun>> makeBackendRuns(const std::vector<std::string>& backends, unsigned threads);

}  // namespace sgm::cli
