#pragma once
// Does work on untrusted input in a sandboxed process, so that a malicious file cannot crash the caller or exhaust the
// machine's memory or time. The process runs the caller's command line with the additional option --sandboxed.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "tools/support/console.h"

namespace sgm::cli {

struct SandboxOptions {
  uint64_t memory = 4096;          ///< limit of the address space in MB (not enforced under a sanitizer, which maps
                                   ///< more)
  double seconds = 300;            ///< limit of the CPU time of all threads (rounded up) and of the wall-clock time
  bool sandboxed = false;          ///< whether the current process is the sandboxed one
  std::vector<std::string> words;  ///< the command line, without the program's name
};

/// Starts the sandboxed process and returns its answer. Errors: those of the work; limit if the process exceeds a limit
/// or a signal ends it; io if it cannot be started or gives no answer. If the calling process ends, the sandboxed
/// process ends too.
Result<std::string> askSandbox(const SandboxOptions& options);

/// Called in the sandboxed process: limits its memory, does the work, and writes the answer for askSandbox() to stdout.
Exit answerFromSandbox(const SandboxOptions& options, const std::function<Result<std::string>()>& work);

}  // namespace sgm::cli
