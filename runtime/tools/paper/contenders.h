#pragma once
// The backends of this machine that generate the stages of the paper's tables.

#include <string>
#include <vector>

#include "tools/paper/stage.h"

namespace sgm::cli {

/// The sequential one first, then one for each named backend, or for all without names. Missing backends are included
/// with the reason, as are software devices that are not named. threads: 0: one for each processor.
Result<std::vector<Contender>> makeContenders(const std::vector<std::string>& backends, unsigned threads);

}  // namespace sgm::cli
