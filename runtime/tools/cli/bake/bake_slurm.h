#pragma once
// `sgm bake --slurm`: submits a bake as jobs of the cluster manager Slurm, and shows its progress.

#include <functional>

#include "base/result.h"
#include "tools/cli/bake/commands.h"
#include "tools/support/console.h"

namespace sgm::cli {

/// Submits a bake into an existing store as Slurm jobs, or finds the jobs of an earlier call that still run. Unless
/// --detach is given, waits for the jobs' end and shows a progress bar on a terminal; interrupting this process does
/// not end the jobs. name: identifies the bake; the same options must give the same name. isThere: returns whether the
/// store contains the world, because Slurm's job records cannot tell whether the bake succeeded.
Exit bakeBySlurm(const BakeOptions& options, const std::string& name, const std::function<Result<bool>()>& isThere);

}  // namespace sgm::cli
