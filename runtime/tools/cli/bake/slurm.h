#pragma once
// A bake as jobs of Slurm: an array of shards, the merge when all have ended well, the verification after that. Slurm
// starts a shard anew whose node has died; whatever a shard had done by then stays done.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

struct SlurmBake {
  std::vector<std::string> bake;    ///< the command of a bake, without --shard and --merge; paths are absolute
  std::vector<std::string> verify;  ///< the command of its verification
  uint64_t shards = 1;
  std::vector<std::string> options;  ///< of sbatch, for every job
  std::string name;                  ///< of the jobs
  std::filesystem::path folder;      ///< is there; scripts, what jobs print, and their numbers
};

/// Numbers of jobs.
struct SlurmJobs {
  std::string shards, merge, verification;
  uint64_t count = 0;  ///< of shards
};

struct SlurmState {
  uint64_t waiting = 0, running = 0,
           failed = 0;              ///< shards; those that are none of it have ended well, as far as known
  std::string merge, verification;  ///< as Slurm calls it: "PENDING"; empty: not known
  bool ended = false;               ///< nothing of it is in the queue
};

// Errors: unsupported where a command of Slurm's is not there; io where one fails, with what it says.

/// Jobs of an earlier call, of whatever count of shards, that wait or run still; none where there are none.
Result<std::optional<SlurmJobs>> findJobs(const SlurmBake& bake);
/// No job stays where one could not be submitted.
Result<SlurmJobs> submitJobs(const SlurmBake& bake);
/// What waits and runs is what the queue has, which knows it at once. How the others have ended is told by Slurm's
/// accounting, which may lag behind, or else by the queue, which forgets it after some minutes.
Result<SlurmState> stateOf(const SlurmJobs& jobs);

}  // namespace sgm::cli
