#pragma once
// The command line of `sgm`.

#include "tools/support/console.h"

namespace sgm::cli {

/// Reads the command line and runs the command that it names. Throws std::bad_alloc, and what a command throws.
Exit runCommandLine(int argc, char** argv);

}  // namespace sgm::cli
