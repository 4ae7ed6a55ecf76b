#pragma once
// Runs another program to its end.

#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

struct ProgramOutput {
  int status = 0;      ///< exit status; 128 plus the signal's number if a signal ended it
  std::string output;  ///< standard output and standard error
};

/// Looks for the program in PATH; its standard input is empty. Errors, with its name: unsupported if it is missing; io
/// if it cannot be started.
Result<ProgramOutput> outputOf(const std::vector<std::string>& command);

}  // namespace sgm::cli
