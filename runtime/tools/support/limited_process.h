#pragma once
// Work on what comes from outside, in a process of its own: whatever a crafted file does there, the caller lives, and
// neither the machine's memory nor its time is used up.

#include <functional>
#include <string>

#include "base/result.h"

namespace sgm::cli {

struct ProcessLimits {
  uint64_t memory = uint64_t{4} << 30;  ///< bytes of address space (not enforced under a sanitizer, which maps more)
  double seconds = 300;  ///< of processor time, all threads together, rounded up to whole ones; and of the clock
};

/// Holds this process to its limits from now on, for good, those of its threads together, and lets it leave no core
/// file.
void limitThisProcess(const ProcessLimits& limits);

/// Runs work() in a child process and returns what it returns. To be called before this process has threads.
/// Errors: those of work(); limit where the child takes more than it may, or ends in any other way than by returning;
/// io where there is no child. A caller that is ended takes the child with it.
Result<std::string> runLimited(const std::function<Result<std::string>()>& work, const ProcessLimits& limits);

}  // namespace sgm::cli
