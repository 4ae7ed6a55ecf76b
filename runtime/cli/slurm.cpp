#include "cli/slurm.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <optional>
#include <set>
#include <sstream>

#include "cli/program_output.h"
#include "store/folder.h"

namespace sgm::cli {
namespace {

/// As a shell reads it back.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string lineOf(const std::vector<std::string>& command) {
  std::string line;
  for (const std::string& word : command) line += (line.empty() ? "" : " ") + quoted(word);
  return line;
}

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

Result<std::string> outputOrError(const std::vector<std::string>& command) {
  Result<ProgramOutput> ran = outputOf(command);
  if (!ran) return ran.error();
  if (ran->status != 0) return Error{Code::io, command[0] + ": " + trimmed(ran->output)};
  return trimmed(ran->output);
}

Result<std::string> submit(const SlurmBake& bake, const std::string& what, const std::string& line,
                           const std::vector<std::string>& own) {
  const std::filesystem::path script = bake.folder / (what + ".sh");
  const std::string text = "#!/bin/sh\nexec " + line + "\n";
  if (const Result<void> written = store::writeFile(script, std::as_bytes(std::span(text)), nullptr); !written)
    return written.error();
  std::vector<std::string> command{"sbatch", "--parsable", "--requeue", "--open-mode=append",
                                   "--job-name=" + bake.name + "-" + what};
  command.insert(command.end(), own.begin(), own.end());
  command.insert(command.end(), bake.options.begin(), bake.options.end());
  command.push_back(script.string());
  Result<std::string> number = outputOrError(command);
  // "NUMBER;CLUSTER" where there are several.
  if (number) *number = number->substr(0, number->find(';'));
  return number;
}

bool isOver(const std::string& state) {
  static const std::set<std::string> kOver{"BOOT_FAIL", "CANCELLED", "COMPLETED",     "DEADLINE",
                                           "FAILED",    "NODE_FAIL", "OUT_OF_MEMORY", "TIMEOUT"};
  return state.empty() || kOver.count(state) != 0;
}

std::filesystem::path numbersOf(const SlurmBake& bake) { return bake.folder / "jobs"; }

}  // namespace

bool SlurmState::ended() const { return waiting == 0 && running == 0 && isOver(merge) && isOver(verification); }

Result<std::optional<SlurmJobs>> findJobs(const SlurmBake& bake) {
  const Result<std::vector<std::byte>> bytes = store::readFile(numbersOf(bake), 4096);
  if (!bytes) return std::optional<SlurmJobs>();
  std::istringstream text(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
  SlurmJobs jobs;
  uint64_t shards = 0;
  if (!(text >> jobs.shards >> jobs.merge >> jobs.verification >> shards) || shards != bake.shards)
    return std::optional<SlurmJobs>();
  const Result<SlurmState> state = stateOf(bake, jobs);
  if (!state) return state.error();
  return state->ended() ? std::optional<SlurmJobs>() : std::optional<SlurmJobs>(jobs);
}

Result<SlurmJobs> submitJobs(const SlurmBake& bake) {
  SlurmJobs jobs;
  const auto log = [&](const std::string& name) { return "--output=" + (bake.folder / name).string(); };
  const std::string threads = " --threads \"${SLURM_CPUS_PER_TASK:-1}\"";
  Result<std::string> number = submit(
      bake, "shard", lineOf(bake.bake) + fmt::format(" --shard \"$SLURM_ARRAY_TASK_ID/{}\"", bake.shards) + threads,
      {fmt::format("--array=0-{}", bake.shards - 1), log("shard-%a.txt")});
  if (!number) return number.error();
  jobs.shards = *number;
  const auto after = [&](const std::string& job) {
    return std::vector<std::string>{"--dependency=afterok:" + job, "--kill-on-invalid-dep=yes"};
  };
  const auto dependent = [&](const std::string& what, const std::string& line, const std::string& job) {
    std::vector<std::string> own = after(job);
    own.push_back(log(what + ".txt"));
    return submit(bake, what, line, own);
  };
  // Jobs that nothing follows would never be merged.
  const auto giveUp = [&](const Error& error) {
    (void)outputOf({"scancel", jobs.shards});
    return error;
  };
  number = dependent("merge", lineOf(bake.bake) + " --merge" + threads, jobs.shards);
  if (!number) return giveUp(number.error());
  jobs.merge = *number;
  number = dependent("verify", lineOf(bake.verify), jobs.merge);
  if (!number) {
    (void)outputOf({"scancel", jobs.merge});
    return giveUp(number.error());
  }
  jobs.verification = *number;
  const std::string text = fmt::format("{} {} {} {}\n", jobs.shards, jobs.merge, jobs.verification, bake.shards);
  if (const Result<void> written = store::writeFile(numbersOf(bake), std::as_bytes(std::span(text)), nullptr); !written)
    return written.error();
  return jobs;
}

Result<SlurmState> stateOf(const SlurmBake& bake, const SlurmJobs& jobs) {
  const std::string all = fmt::format("{},{},{}", jobs.shards, jobs.merge, jobs.verification);
  // "NUMBER_TASK STATE" a line.
  Result<ProgramOutput> told = outputOf({"sacct", "-n", "-X", "--array", "-j", all, "-o", "JobID%40,State%20"});
  if (!told || told->status != 0) told = outputOf({"squeue", "-h", "-r", "-t", "all", "-j", all, "-o", "%i %T"});
  if (!told) return told.error();
  // The queue knows none of them any more.
  if (told->status != 0 && told->output.find("Invalid job id") != std::string::npos) *told = {};
  if (told->status != 0) return Error{Code::io, "squeue: " + trimmed(told->output)};
  SlurmState state;
  uint64_t listed = 0;
  std::istringstream lines(told->output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string job, how;
    if (!(words >> job >> how)) continue;
    const std::string number = job.substr(0, job.find('_'));
    if (number == jobs.merge) state.merge = how;
    if (number == jobs.verification) state.verification = how;
    if (number != jobs.shards) continue;
    ++listed;
    if (how == "COMPLETED") {
      ++state.done;
    } else if (isOver(how)) {
      ++state.failed;
    } else if (how == "RUNNING" || how == "COMPLETING") {
      ++state.running;
    } else {
      ++state.waiting;
    }
  }
  // What the queue has forgotten has ended well, or the merge would have been cancelled with it.
  if (listed < bake.shards && listed + state.failed > 0) state.done += bake.shards - listed;
  return state;
}

}  // namespace sgm::cli
