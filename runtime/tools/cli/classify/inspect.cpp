// sgm inspect: the process that reads uploads of the metrics service. It limits itself before it reads, opens no file
// but the base of reference histograms, and writes its result once, at the end.

#include "tools/cli/classify/inspect.h"

#include <fmt/core.h>
#include <sys/mman.h>
#if defined(__linux__)
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>

#include "base/plain_text.h"
#include "tools/cli/classify/commands.h"
#include "tools/support/limited_process.h"

namespace sgm::cli {
namespace {

/// For any file that the process writes: more than an answer or a base needs.
constexpr rlim_t kMostFileBytes = rlim_t{256} << 20;
/// For its streams, a base with its journal, and files that libraries open briefly.
constexpr rlim_t kMostDescriptors = 32;

void holdTo(const InspectOptions& options) {
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
#if defined(SYS_close_range)
  // Close descriptors that the host has leaked.
  syscall(SYS_close_range, 3u, ~0u, 0u);
#endif
#endif
  const rlimit files{kMostFileBytes, kMostFileBytes};
  setrlimit(RLIMIT_FSIZE, &files);
  // Do not set RLIMIT_NPROC: it counts all processes of the user, so on a busy machine this one could start no thread.
  const rlimit descriptors{kMostDescriptors, kMostDescriptors};
  setrlimit(RLIMIT_NOFILE, &descriptors);
  ProcessLimits limits;
  limits.memory = options.memory << 20;
  limits.seconds = static_cast<double>(options.seconds);
  limitThisProcess(limits);
}

/// All of standard input. Error: io.
Result<std::vector<std::byte>> readInput() {
  const auto failed = [] {
    return Error{Code::io, fmt::format("cannot read standard input: {}", systemMessage(errno))};
  };
  struct stat info {};
  if (fstat(STDIN_FILENO, &info) != 0) return failed();
  std::vector<std::byte> bytes;
  bytes.reserve(S_ISREG(info.st_mode) ? static_cast<size_t>(info.st_size) + 1 : 0);
  constexpr size_t kPiece = size_t{1} << 20;
  for (size_t size = 0;;) {
    bytes.resize(std::max(size + kPiece, bytes.capacity()));
    const ssize_t more = read(STDIN_FILENO, bytes.data() + size, bytes.size() - size);
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) return failed();
    size += static_cast<size_t>(more);
    if (more == 0) {
      bytes.resize(size);
      return bytes;
    }
  }
}

bool writeOutput(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return true;
}

std::string framed(const InspectAnswer& answer) {
  std::string bytes;
  for (const std::string& part : {answer.json.line(), answer.preview}) {
    for (unsigned shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(uint64_t{part.size()} >> shift);
    bytes += part;
  }
  return bytes;
}

InspectAnswer answerOf(const InspectOptions& options) {
  if (options.list_masters) return {listedMasters(options), {}};
  // Open the base before reading untrusted input.
  std::optional<Result<masters::OpenedBase>> base;
  if (!options.store_masters) base = inspectedBase(options.masters);
  const Result<std::vector<std::byte>> bytes = readInput();
  if (!bytes) return {toJson(problemOf(bytes.error(), options)), {}};
  if (options.store_masters) return {storedMasters(*bytes, options), {}};
  return inspectUpload(*bytes, options, *base);
}

const char* titleOf(int status) {
  switch (status) {
    case 400:
      return "Bad Request";
    case 409:
      return "Conflict";
    case 422:
      return "Unprocessable Entity";
    default:
      return "Internal Server Error";
  }
}

}  // namespace

Json toJson(const InspectProblem& problem) {
  Json json{{"type", "about:blank"},
            {"title", titleOf(problem.status)},
            {"status", problem.status},
            {"code", problem.code},
            {"detail", problem.detail}};
  if (!problem.pointer.empty()) json["pointer"] = problem.pointer;
  if (problem.line > 0) json["line"] = problem.line;
  if (problem.column > 0) json["column"] = problem.column;
  if (problem.diagnostics) json["diagnostics"] = *problem.diagnostics;
  return json;
}

InspectProblem outOfMemory(const InspectOptions& options) {
  InspectProblem problem;
  problem.status = 500;
  problem.code = "validator_limit";
  problem.detail = fmt::format(
      "the validation takes more than {} MB of memory, the limit of the service: send a smaller file", options.memory);
  return problem;
}

InspectProblem problemOf(const Error& error, const InspectOptions& options) {
  if (error.code == Code::out_of_memory) return outOfMemory(options);
  InspectProblem problem;
  problem.detail = error.message;
  problem.line = error.line;
  problem.column = error.column;
  const bool of_upload = error.code == Code::bad_input || error.code == Code::invalid_argument ||
                         error.code == Code::range || error.code == Code::limit;
  if (of_upload) return problem;
  problem.status = 500;
  problem.code = "validator_crashed";
  return problem;
}

Exit inspect(const InspectOptions& options) {
  holdTo(options);
  std::string bytes;
  try {
    bytes = framed(answerOf(options));
  } catch (const std::bad_alloc&) {
    bytes = framed({toJson(outOfMemory(options)), {}});
  }
  return writeOutput(bytes) ? Exit::done : complain(Exit::file, "cannot write to standard output");
}

}  // namespace sgm::cli
