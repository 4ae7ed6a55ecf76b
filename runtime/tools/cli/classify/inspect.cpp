// `sgm inspect`: the process that reads uploads of the metrics service. It restricts itself before it reads, opens no
// file but the database of reference histograms, and writes its result once, at the end.

#include "tools/cli/classify/inspect.h"

#include <fmt/core.h>

#include <new>

#include "base/file_reader.h"
#include "base/platform/process.h"
#include "tools/cli/classify/commands.h"

namespace sgm::cli {
namespace {

/// Maximum size of a file that the process may write: more than the result or a database of reference histograms needs.
constexpr uint64_t kMaxFileBytes = uint64_t{256} << 20;
/// Maximum number of open files: the standard streams, a database with its journal, and files that libraries open
/// briefly.
constexpr uint64_t kMaxDescriptors = 32;
constexpr int kStandardInput = 0, kStandardOutput = 1;

void holdTo(const InspectOptions& options) {
  platform::ProcessLimits limits;
  limits.memory_bytes = options.memory << 20;
  limits.cpu_seconds = static_cast<double>(options.seconds);
  limits.file_bytes = kMaxFileBytes;
  limits.open_files = kMaxDescriptors;
  platform::sandboxThisProcess(limits);
}

bool writeOutput(std::string_view bytes) {
  while (!bytes.empty()) {
    const ptrdiff_t written = platform::writeNext(kStandardOutput, bytes.data(), bytes.size());
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
  // Open the database of reference histograms before reading untrusted input.
  std::optional<Result<masters::OpenedBase>> base;
  if (!options.store_masters) base = inspectedBase(options.masters);
  const Result<std::string> input = readOpenFile(kStandardInput, "standard input", UINT64_MAX);
  if (!input) return {toJson(problemOf(input.error(), options)), {}};
  const std::span bytes = std::as_bytes(std::span(*input));
  if (options.store_masters) return {storedMasters(bytes, options), {}};
  return inspectUpload(bytes, options, *base);
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
  return writeOutput(bytes) ? Exit::done : reportError(Exit::file, "cannot write to standard output");
}

}  // namespace sgm::cli
