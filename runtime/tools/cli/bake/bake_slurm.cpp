#include "tools/cli/bake/bake_slurm.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/json.h"
#include "base/platform/process.h"
#include "store/folder.h"
#include "tools/cli/bake/commands.h"
#include "tools/cli/bake/slurm.h"

namespace sgm::cli {
namespace {

namespace fs = std::filesystem;

/// Pause between queries of the jobs' state. Slurm's controller serves many users, so it must not be queried often.
constexpr auto kBetweenLooks = std::chrono::seconds(1);

void report(const BakeOptions& options, const SlurmJobs& jobs, const SlurmState& state, bool there) {
  if (options.json) {
    fmt::print("{}\n",
               Json{{"jobs", {{"shards", jobs.shards}, {"merge", jobs.merge}, {"verification", jobs.verification}}},
                    {"shards", jobs.count},
                    {"waiting", state.waiting},
                    {"running", state.running},
                    {"failed", state.failed},
                    {"merge", state.merge},
                    {"verification", state.verification},
                    {"baked", there}}
                   .text());
    return;
  }
  fmt::print("{}: jobs {}, {} and {}: {} of {} shards waiting, {} running, {} failed; merge {}, verification {}\n",
             options.out, jobs.shards, jobs.merge, jobs.verification, state.waiting, jobs.count, state.running,
             state.failed, state.merge.empty() ? "unknown" : state.merge,
             state.verification.empty() ? "unknown" : state.verification);
}

Result<SlurmBake> slurmBakeOf(const BakeOptions& options, const std::string& name) {
  const auto absolute = [](const std::string& path) { return fs::absolute(path).lexically_normal().string(); };
  const Result<std::string> program = platform::ownProgram();
  if (!program) return program.error();
  SlurmBake bake;
  bake.bake = {*program,       "bake",   absolute(options.file),       "--out",     absolute(options.out), "--levels",
               options.levels, "--seed", std::to_string(options.seed), "--backend", options.backend};
  for (const std::string& set : options.sets) bake.bake.insert(bake.bake.end(), {"--set", set});
  if (!options.region.empty()) bake.bake.insert(bake.bake.end(), {"--region", options.region});
  if (options.cell) bake.bake.insert(bake.bake.end(), {"--cell", fmt::format("{}", *options.cell)});
  if (options.density) bake.bake.insert(bake.bake.end(), {"--ld", fmt::format("{}", *options.density)});
  if (options.sharp) bake.bake.push_back("--sharp");
  bake.verify = {*program, "store", "verify", absolute(options.out)};
  bake.shards = options.slurm;
  bake.options = options.sbatch;
  bake.name = "sgm-" + name.substr(0, 8);
  bake.folder = fs::path(absolute(options.out)) / "slurm" / name;
  return bake;
}

/// Converts the error of a Slurm command; if that command is missing, the message also names alternatives to --slurm.
Error withoutSlurm(const Error& error) {
  if (error.code != Code::unsupported) return error;
  return {Code::io, error.message +
                        ". Without Slurm, bake each share with --shard; samples/bake has scripts for other schedulers"};
}

}  // namespace

Exit bakeBySlurm(const BakeOptions& options, const std::string& name, const std::function<Result<bool>()>& isThere) {
  const Result<SlurmBake> bake = slurmBakeOf(options, name);
  if (!bake) return reportError(bake.error());
  if (const Result<void> made = store::makeFolder(bake->folder); !made) return reportError(made.error());
  const Result<std::optional<SlurmJobs>> found = findJobs(*bake);
  if (!found) return reportError(withoutSlurm(found.error()));
  const bool is_new = !found->has_value();
  const Result<SlurmJobs> jobs = is_new ? submitJobs(*bake) : Result<SlurmJobs>(**found);
  if (!jobs) return reportError(withoutSlurm(jobs.error()));
  fmt::print(stderr,
             "sgm: Slurm jobs {} (shards), {} (merge) and {} (verification) {}; stopping this program does not end "
             "them, scancel does\n",
             jobs->shards, jobs->merge, jobs->verification, is_new ? "are submitted" : "are under way");
  Result<SlurmState> state = stateOf(*jobs);
  {
    ProgressBar bar("baking");
    while (state && !options.detach && !state->ended) {
      bar.show(jobs->count - std::min(jobs->count, state->waiting + state->running), jobs->count);
      std::this_thread::sleep_for(kBetweenLooks);
      state = stateOf(*jobs);
    }
  }
  if (!state) return reportError(withoutSlurm(state.error()));
  const Result<bool> there = isThere();
  report(options, *jobs, *state, there && *there);
  if (options.detach) return Exit::done;
  if (!there) return reportError(there.error());
  if (*there && state->verification == "COMPLETED") return Exit::done;
  if (*there && state->verification.empty()) {
    return reportError(Exit::input,
                       "the world is in the store, but Slurm does not report how its verification ended: check it with "
                       "sgm store verify");
  }
  return reportError(
      Exit::input,
      fmt::format(
          "some of the jobs did not succeed: '{}' has their output; run the same command again to bake what is missing",
          bake->folder.string()));
}

}  // namespace sgm::cli
