#pragma once
// Who generates the stages of the paper's tables on this machine.

#include <string>
#include <vector>

#include "tools/paper/stage.h"

namespace sgm::cli {

/// The sequential one first, then one a backend: of these names, and all of them where none is given. What is not here
/// is among them with the reason, and so is a software device that nobody has named. threads: 0 is one a processor.
Result<std::vector<Contender>> makeContenders(const std::vector<std::string>& backends, unsigned threads);

}  // namespace sgm::cli
