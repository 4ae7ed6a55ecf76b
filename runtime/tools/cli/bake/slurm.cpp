#include "tools/cli/bake/slurm.h"

#include <fmt/core.h>

#include <optional>
#include <set>
#include <sstream>

#include "base/file_reader.h"
#include "base/platform/process.h"
#include "store/folder.h"

namespace sgm::cli {
namespace {

/// The word in quotes, so that a POSIX shell reads it literally.
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

/// Runs a Slurm command. Returns the text that it writes to standard output and standard error. Error: unsupported if
/// the command is missing.
Result<platform::ProcessOutput> runSlurm(const std::vector<std::string>& command) {
  platform::ProcessSettings settings;
  settings.program = command[0];
  settings.arguments.assign(command.begin() + 1, command.end());
  settings.input = {platform::Stream::none};
  settings.output = {platform::Stream::pipe};
  settings.error = {platform::Stream::output};
  return platform::runProcess(settings);
}

Result<std::string> outputOrError(const std::vector<std::string>& command) {
  const Result<platform::ProcessOutput> ran = runSlurm(command);
  if (!ran) return ran.error();
  if (!ran->exit.succeeded()) return Error{Code::io, command[0] + ": " + trimmed(ran->output)};
  return trimmed(ran->output);
}

bool isNumber(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
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
  const Result<std::string> said = outputOrError(command);
  if (!said) return said.error();
  // The command sbatch prints "NUMBER", or "NUMBER;CLUSTER" with several clusters. Depending on the site's
  // configuration, it prints other lines as well, which are skipped.
  std::istringstream lines(*said);
  for (std::string words; std::getline(lines, words);) {
    const std::string number = words.substr(0, words.find(';'));
    if (isNumber(number)) return number;
  }
  return Error{Code::io, "sbatch printed no job number: " + *said};
}

/// Job numbers and the states of the jobs or their tasks, read from lines such as "NUMBER_TASK STATE".
using States = std::vector<std::pair<std::string, std::string>>;

Result<States> statesFrom(const std::vector<std::string>& command) {
  const Result<platform::ProcessOutput> told = runSlurm(command);
  if (!told) return told.error();
  // The command squeue fails with this message if the queue contains none of the jobs.
  if (!told->exit.succeeded() && told->output.find("Invalid job id") != std::string::npos) return States();
  if (!told->exit.succeeded()) return Error{Code::io, command[0] + ": " + trimmed(told->output)};
  States states;
  std::istringstream lines(told->output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string job, how;
    if (!(words >> job >> how)) continue;
    job = job.substr(0, job.find('_'));
    // Lines that do not begin with a job number are warnings of Slurm.
    if (isNumber(job)) states.emplace_back(job, how);
  }
  return states;
}

std::filesystem::path numbersOf(const SlurmBake& bake) { return bake.folder / "jobs"; }

}  // namespace

Result<std::optional<SlurmJobs>> findJobs(const SlurmBake& bake) {
  const Result<std::string> numbers = readFile(numbersOf(bake), 4096);
  if (!numbers) return std::optional<SlurmJobs>();
  std::istringstream text(*numbers);
  SlurmJobs jobs;
  if (!(text >> jobs.shards >> jobs.merge >> jobs.verification >> jobs.count)) return std::optional<SlurmJobs>();
  const Result<SlurmState> state = stateOf(jobs);
  if (!state) return state.error();
  return state->ended ? std::optional<SlurmJobs>() : std::optional<SlurmJobs>(jobs);
}

Result<SlurmJobs> submitJobs(const SlurmBake& bake) {
  SlurmJobs jobs;
  jobs.count = bake.shards;
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
  // Cancels the jobs submitted so far if a later job cannot be submitted or the job numbers cannot be stored: otherwise
  // they would run concurrently with the jobs of the next call.
  const auto giveUp = [&](const Error& error) {
    for (const std::string& job : {jobs.verification, jobs.merge, jobs.shards}) {
      if (!job.empty()) (void)runSlurm({"scancel", job});
    }
    return error;
  };
  number = dependent("merge", lineOf(bake.bake) + " --merge" + threads, jobs.shards);
  if (!number) return giveUp(number.error());
  jobs.merge = *number;
  number = dependent("verify", lineOf(bake.verify), jobs.merge);
  if (!number) return giveUp(number.error());
  jobs.verification = *number;
  const std::string text = fmt::format("{} {} {} {}\n", jobs.shards, jobs.merge, jobs.verification, bake.shards);
  if (const Result<void> written = store::writeFile(numbersOf(bake), std::as_bytes(std::span(text)), nullptr); !written)
    return giveUp(written.error());
  return jobs;
}

Result<SlurmState> stateOf(const SlurmJobs& jobs) {
  const std::string all = fmt::format("{},{},{}", jobs.shards, jobs.merge, jobs.verification);
  const Result<States> queue = statesFrom({"squeue", "-h", "-r", "-j", all, "-o", "%i %T"});
  if (!queue) return queue.error();
  Result<States> ended = statesFrom({"sacct", "-n", "-X", "-j", all, "-o", "JobID%40,State%20"});
  if (!ended) ended = statesFrom({"squeue", "-h", "-r", "-t", "all", "-j", all, "-o", "%i %T"});
  SlurmState state;
  state.ended = queue->empty();
  // Apply the states from the queue last, because they are more recent than those from the accounting.
  for (const States* states : std::initializer_list<const States*>{ended ? &*ended : nullptr, &*queue}) {
    for (size_t i = 0; states != nullptr && i < states->size(); ++i) {
      const auto& [job, how] = (*states)[i];
      if (job == jobs.merge) state.merge = how;
      if (job == jobs.verification) state.verification = how;
      if (job != jobs.shards) continue;
      if (states == &*queue) ++(how == "RUNNING" || how == "COMPLETING" ? state.running : state.waiting);
      static const std::set<std::string> kFailed{"BOOT_FAIL", "CANCELLED", "CANCELLED+", "DEADLINE",      "FAILED",
                                                 "NODE_FAIL", "PREEMPTED", "REVOKED",    "OUT_OF_MEMORY", "TIMEOUT"};
      if (states != &*queue) state.failed += kFailed.count(how);
    }
  }
  return state;
}

}  // namespace sgm::cli
