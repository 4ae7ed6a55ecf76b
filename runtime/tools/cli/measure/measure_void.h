#pragma once
// What `sgm measure` says of a grammar's void instead of its surface, and of a way through it.

#include "tools/cli/measure/commands.h"
#include "tools/support/console.h"

namespace sgm::cli {

/// Whether the options ask for the void.
bool asksForVoid(const MeasureOptions& options);

/// The voids of a region, and a way where --from and --to ask for one. Exit::input where there is none.
Exit measureVoid(const MeasureOptions& options);

}  // namespace sgm::cli
