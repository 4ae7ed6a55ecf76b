#pragma once
// The report of `sgm measure` on the void of a grammar's world instead of its surface, and on a path through the void.

#include "tools/cli/measure/commands.h"
#include "tools/support/console.h"

namespace sgm::cli {

/// Whether the options request measures of the void.
bool asksForVoid(const MeasureOptions& options);

/// Reports the connected voids of a region, and a path through them if --from and --to request one. Returns Exit::input
/// if there is no such path.
Exit measureVoid(const MeasureOptions& options);

}  // namespace sgm::cli
