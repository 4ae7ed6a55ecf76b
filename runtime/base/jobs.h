#pragma once
// The job system that a runtime is given (or makes): the one way in which our code runs in parallel.

#include <cstddef>
#include <functional>
#include <memory>

namespace sgm {

/// Contract: submit() may run the function at once, later, on any thread, in any order; it must run it exactly once.
/// help() runs one waiting job on the calling thread if there is one, and says whether it did.
class JobSystem {
 public:
  virtual ~JobSystem() = default;
  virtual unsigned concurrency() const = 0;  ///< threads that may run jobs at one time, at least 1
  virtual void submit(void (*function)(void*), void* argument, int priority) = 0;
  virtual bool help() = 0;
};

/// Threads of our own. threads = 0: one for each processor.
std::unique_ptr<JobSystem> makeThreadPool(unsigned threads);

/// Runs body(i) for i in [0, count) on the job system and returns when all are done; the caller's thread works too.
/// The first exception of a body is thrown again here, after all have ended.
void parallelFor(JobSystem& jobs, size_t count, const std::function<void(size_t)>& body);

}  // namespace sgm
