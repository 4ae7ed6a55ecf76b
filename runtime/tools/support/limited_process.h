#pragma once
// Work on untrusted input in a sandboxed process: a crafted file cannot crash the caller, or exhaust memory or time of
// the machine.

#include <functional>
#include <string>

#include "base/result.h"

namespace sgm::cli {

struct ProcessLimits {
  uint64_t memory = uint64_t{4} << 30;  ///< bytes of address space (not enforced under a sanitizer, which maps more)
  double seconds = 300;                 ///< of processor time (sum of all threads, rounded up), and of wall time
};

/// Limits this process permanently (the sum of its threads), and disables its core files.
void limitThisProcess(const ProcessLimits& limits);

/// Runs work() in a child process and returns its result. To be called before this process has threads. Errors: those
/// of work(); limit if the child exceeds a limit or is ended by a signal; io if there is no child, or it returns
/// nothing. If the caller is ended, so is the child.
Result<std::string> runLimited(const std::function<Result<std::string>()>& work, const ProcessLimits& limits);

}  // namespace sgm::cli
