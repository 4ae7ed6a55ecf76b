#pragma once
// Entry point of the command line of `sgm`.

#include "tools/support/console.h"

namespace sgm::cli {

/// Parses the command line and runs the command that it names. Throws std::bad_alloc and the exceptions of the command.
Exit runCommandLine(int argc, char** argv);

}  // namespace sgm::cli
