#pragma once
// The report of `sgm measure` on a grammar's void instead of its surface, and on a path through it.

#include "tools/cli/measure/commands.h"
#include "tools/support/console.h"

namespace sgm::cli {

/// Whether the options ask for the void.
bool asksForVoid(const MeasureOptions& options);

/// Reports the voids of a region, and a path if --from and --to request one. Exit::input if there is no path.
Exit measureVoid(const MeasureOptions& options);

}  // namespace sgm::cli
