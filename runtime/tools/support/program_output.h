#pragma once
// Another program, run to its end.

#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

struct ProgramOutput {
  int status = 0;      ///< of its exit; 128 and the signal's number where one ended it
  std::string output;  ///< standard output and standard error
};

/// Looks for the program in PATH; its standard input is empty. unsupported: it is not there; io: it cannot be started;
/// both with its name.
Result<ProgramOutput> outputOf(const std::vector<std::string>& command);

}  // namespace sgm::cli
