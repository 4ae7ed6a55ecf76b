#pragma once
// sgm bake --slurm: submits a bake, and shows its progress.

#include <functional>

#include "base/result.h"
#include "tools/cli/bake/commands.h"
#include "tools/support/console.h"

namespace sgm::cli {

/// Submits a bake into an existing store, or finds its running jobs; unless --detach, waits for their end, with a
/// progress bar on a terminal. Interrupting it stops only the waiting. name: of the bake, the same for the same bake.
/// isThere: whether the store has the world, since Slurm's job records cannot tell.
Exit bakeBySlurm(const BakeOptions& options, const std::string& name, const std::function<Result<bool>()>& isThere);

}  // namespace sgm::cli
