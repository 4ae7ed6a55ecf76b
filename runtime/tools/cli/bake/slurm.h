#pragma once
// Runs a bake as jobs of Slurm: an array job with a task for each shard, a merge job that starts after all shards have
// succeeded, and then a verification job. If a node dies, Slurm restarts the task of its shard; the tiles that the task
// has finished are kept.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

struct SlurmBake {
  std::vector<std::string> bake;    ///< command line of the bake, without --shard and --merge; paths are absolute
  std::vector<std::string> verify;  ///< command line that verifies the baked world
  uint64_t shards = 1;
  std::vector<std::string> options;  ///< options of sbatch, for every job
  std::string name;                  ///< name of the jobs in Slurm
  std::filesystem::path folder;      ///< folder for the scripts, the jobs' output, and the job numbers; must exist
};

/// The numbers that Slurm has assigned to the jobs of a bake.
struct SlurmJobs {
  std::string shards, merge, verification;
  uint64_t count = 0;  ///< number of shards
};

struct SlurmState {
  uint64_t waiting = 0, running = 0,
           failed = 0;  ///< numbers of shards in these states; all other shards have succeeded, as far as known
  /// State of the merge job and of the verification job, as Slurm prints it ("PENDING"); empty if unknown.
  std::string merge, verification;
  bool ended = false;  ///< true if none of the jobs is in the queue any more
};

// Errors of the functions below: unsupported if a command of Slurm is missing; io, with its output, if a command fails.

/// Finds jobs of an earlier call, with any number of shards, that still wait or run; nullopt if there are none.
Result<std::optional<SlurmJobs>> findJobs(const SlurmBake& bake);
/// Submits all jobs of a bake. If one job cannot be submitted, cancels the others.
Result<SlurmJobs> submitJobs(const SlurmBake& bake);
/// The state of the jobs. Waiting and running jobs are read from Slurm's queue, which is current. The results of ended
/// jobs are read from Slurm's accounting, which may lag behind. Without accounting they are read from the queue, which
/// forgets ended jobs after some minutes.
Result<SlurmState> stateOf(const SlurmJobs& jobs);

}  // namespace sgm::cli
