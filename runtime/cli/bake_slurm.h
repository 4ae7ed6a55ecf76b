#pragma once
// sgm bake --slurm: submits a bake, and shows how far it is.

#include "cli/commands.h"
#include "cli/slurm.h"

namespace sgm::cli {

/// The jobs of a bake into a store that is there. name: of the bake, the same for the same bake.
SlurmBake slurmBakeOf(const BakeOptions& options, const std::string& name);

/// Submits it, or finds it under way; unless --detach, returns when all has ended, with a bar on a terminal meanwhile.
/// Being stopped ends the watching alone.
Exit bakeBySlurm(const BakeOptions& options, const SlurmBake& bake);

}  // namespace sgm::cli
