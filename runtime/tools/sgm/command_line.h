#pragma once
// The command line of `sgm`.

#include "tools/support/console.h"

namespace sgm::cli {

/// Parses the command line and runs its command. Throws std::bad_alloc, and the exceptions of the command.
Exit runCommandLine(int argc, char** argv);

}  // namespace sgm::cli
