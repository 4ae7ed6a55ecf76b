#pragma once
// A bake as jobs of Slurm: an array of shards, the merge after all have succeeded, then the verification. If a node
// dies, Slurm restarts its shard, which keeps its finished tiles.

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
  std::filesystem::path folder;      ///< exists; holds scripts, the jobs' output, and their numbers
};

/// Job numbers.
struct SlurmJobs {
  std::string shards, merge, verification;
  uint64_t count = 0;  ///< of shards
};

struct SlurmState {
  uint64_t waiting = 0, running = 0,
           failed = 0;              ///< shards; all others have succeeded, as far as known
  std::string merge, verification;  ///< Slurm's word: "PENDING"; empty: unknown
  bool ended = false;               ///< no job is in the queue
};

// Errors: unsupported if a command of Slurm is missing; io if it fails, with its output.

/// Jobs of an earlier call, with any number of shards, that still wait or run; nullopt if there are none.
Result<std::optional<SlurmJobs>> findJobs(const SlurmBake& bake);
/// If a job cannot be submitted, cancels the others.
Result<SlurmJobs> submitJobs(const SlurmBake& bake);
/// Waiting and running jobs come from the queue, which is current. The results of ended jobs come from Slurm's
/// accounting, which may lag behind, or without it from the queue, which forgets them after some minutes.
Result<SlurmState> stateOf(const SlurmJobs& jobs);

}  // namespace sgm::cli
