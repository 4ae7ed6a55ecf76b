#pragma once
// Work on untrusted input in a sandboxed process: a crafted file cannot crash the caller, or exhaust memory or time of
// the machine. The process runs the same command line, with one option more: --sandboxed.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "tools/support/console.h"

namespace sgm::cli {

struct SandboxOptions {
  uint64_t memory = 4096;          ///< MB of address space (not enforced under a sanitizer, which maps more)
  double seconds = 300;            ///< of processor time (sum of all threads, rounded up), and of wall time
  bool sandboxed = false;          ///< this is the sandboxed process
  std::vector<std::string> words;  ///< the command line, without the program's name
};

/// Starts the sandboxed process and returns its answer. Errors: those of its work; limit if it exceeds a limit or is
/// ended by a signal; io if it cannot be started or answers nothing. If the caller is ended, so is the process.
Result<std::string> askSandbox(const SandboxOptions& options);

/// In the sandboxed process: limits its memory, does the work, and answers askSandbox() on standard output.
Exit answerFromSandbox(const SandboxOptions& options, const std::function<Result<std::string>()>& work);

}  // namespace sgm::cli
