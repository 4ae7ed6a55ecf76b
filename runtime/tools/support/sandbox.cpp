#include "tools/support/sandbox.h"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <new>

#include "base/platform/process.h"

namespace sgm::cli {
namespace {

using platform::ProcessExit;
using platform::ProcessOutput;

/// First character of the answer. After kDone follows the result; after kFailed, the error's code and message.
constexpr char kDone = 'd', kFailed = 'f';

Error tooMuchMemory(const SandboxOptions& options) {
  return {Code::limit,
          fmt::format("it takes more than {} MB of memory: allow more with --memory, or use a smaller file",
                      options.memory)};
}

/// The error that follows from the way in which the process ended, such as a crash or a time limit; nullopt if it ended
/// by itself and in time.
std::optional<Error> problemOf(const ProcessOutput& said, const SandboxOptions& options) {
  switch (said.exit.kind) {
    case ProcessExit::Kind::out_of_time:
      break;
    case ProcessExit::Kind::crashed:
      return Error{Code::limit, fmt::format("the process that read it crashed with signal {}: this is a bug in sgm, "
                                            "please send us the file",
                                            said.exit.number)};
    case ProcessExit::Kind::killed:
    case ProcessExit::Kind::ended:
      if (said.stop == ProcessOutput::Stop::time_limit) break;
      return Error{
          Code::limit,
          fmt::format("the process that read it was killed from outside, by signal {}{}", said.exit.number,
                      said.exit.kind == ProcessExit::Kind::killed ? ": the machine may be out of memory" : "")};
    case ProcessExit::Kind::exited:
    case ProcessExit::Kind::unknown:
      if (said.stop == ProcessOutput::Stop::time_limit) break;
      return std::nullopt;
  }
  return Error{Code::limit, fmt::format("it takes more than {} s: allow more with --seconds, or use a smaller file",
                                        options.seconds)};
}

Result<std::string> guarded(const std::function<Result<std::string>()>& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return Error{Code::out_of_memory, ""};
  } catch (const std::exception& e) {
    return Error{Code::limit, e.what()};
  }
}

}  // namespace

Result<std::string> askSandbox(const SandboxOptions& options) {
  const Result<std::string> program = platform::ownProgram();
  if (!program) return program.error();
  platform::ProcessSettings settings;
  settings.program = *program;
  settings.arguments = options.words;
  // Insert the option right after the command's name: after a "--", it would be taken for a file name.
  settings.arguments.insert(settings.arguments.begin() + 1, "--sandboxed");
  settings.output = {platform::Stream::pipe};
  settings.inherits_files = true;  // an argument may name an inherited file, as /dev/fd/5
  settings.sandbox.emplace().cpu_seconds = options.seconds;
  platform::RunSettings run;
  run.time = std::chrono::ceil<std::chrono::milliseconds>(std::chrono::duration<double>(options.seconds));
  // Write this process's buffered output now: otherwise it would appear after the messages of the child process.
  std::fflush(nullptr);
  Result<ProcessOutput> said = platform::runProcess(settings, run);
  if (!said) return said.error();
  if (const std::optional<Error> problem = problemOf(*said, options)) return *problem;

  std::string& answer = said->output;
  if (answer.starts_with(kDone) && (said->exit.succeeded() || said->exit.kind == ProcessExit::Kind::unknown)) {
    answer.erase(0, 1);
    return std::move(answer);
  }
  if (!answer.starts_with(kFailed) || answer.size() < 2)
    return Error{Code::io, "the process that read it ended without an answer"};
  const auto code = static_cast<Code>(answer[1]);
  if (code == Code::out_of_memory) return tooMuchMemory(options);
  return Error{code, answer.substr(2)};
}

Exit answerFromSandbox(const SandboxOptions& options, const std::function<Result<std::string>()>& work) {
  // Set the memory limit only now, after the libraries are loaded. If the limit prevented loading them, the process
  // would end without an answer.
  platform::ProcessLimits limits;
  limits.memory_bytes = options.memory << 20;
  platform::limitThisProcess(limits);
  const Result<std::string> result = guarded(work);
  if (result) {
    std::fputc(kDone, stdout);
    std::fwrite(result->data(), 1, result->size(), stdout);
  } else {
    std::fputc(kFailed, stdout);
    std::fputc(static_cast<char>(result.error().code), stdout);
    std::fwrite(result.error().message.data(), 1, result.error().message.size(), stdout);
  }
  return Exit::done;
}

}  // namespace sgm::cli
