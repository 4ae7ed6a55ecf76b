#pragma once
// sgm bake --slurm: submits a bake, and shows how far it is.

#include <functional>

#include "base/result.h"
#include "tools/cli/bake/commands.h"
#include "tools/support/console.h"

namespace sgm::cli {

/// Submits a bake into a store that is there, or finds it under way; unless --detach, returns when all has ended, with
/// a bar on a terminal meanwhile. Being stopped ends the watching alone. name: of the bake, the same for the same bake.
/// isThere: whether the store has it; what Slurm remembers of jobs does not tell.
Exit bakeBySlurm(const BakeOptions& options, const std::string& name, const std::function<Result<bool>()>& isThere);

}  // namespace sgm::cli
