#pragma once
// The job system that a runtime is given (or makes): the one way in which the library computes in parallel. Apart from
// it are threads that wait for a store on a server (stream/world_core.h), and one that compiles shaders.
//
// N threads mean N workers. concurrency() counts the thread that asks for the work: a loop or a batch is never worked
// on by more threads than that at one time, its caller's included. So a thread pool of N workers starts N - 1 threads
// (but one at least, for batches that nobody waits for).

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>

#include "base/profile.h"
#include "base/result.h"

namespace sgm {

/// Contract: submit() may run the function at once, later, on any thread, in any order, or only within help(); it must
/// run it exactly once. The functions that we submit let no exception out, and one that comes late finds nothing to do:
/// nobody waits for a job that has not begun. help() runs one waiting job on the calling thread if there is one, and
/// says whether it did.
class JobSystem {
 public:
  virtual ~JobSystem() = default;
  virtual unsigned concurrency() const = 0;  ///< workers at one time, the caller's thread included, at least 1
  virtual void submit(void (*function)(void*), void* argument, int priority) = 0;
  virtual bool help() = 0;
};

/// Threads of our own. workers = 0: one for each processor. Where the machine does not let all of them start, those
/// that did do the work, and concurrency() says how many. The profiler is told their names: "sgm worker 1" and so on;
/// `names`, short and of static lifetime, in place of "sgm worker". Errors, where not one thread starts: limit,
/// out_of_memory.
Result<std::unique_ptr<JobSystem>> makeThreadPool(unsigned workers, const Profiler& profiler = {},
                                                  const char* names = "sgm worker");

/// Runs body(i) for i in [0, count) on the job system and returns when all are done; the caller's thread works too.
/// The first exception of a body is thrown again here, after all have ended.
void parallelFor(JobSystem& jobs, size_t count, const std::function<void(size_t)>& body);

/// Returns when ended() holds, which the lock guards and `changed` tells of. Meanwhile runs waiting jobs of the system:
/// it may have no other thread that would.
template <class Ended>
void helpUntil(JobSystem& jobs, std::unique_lock<std::mutex>& lock, std::condition_variable& changed, Ended ended) {
  constexpr auto kBetweenHelps = std::chrono::milliseconds(1);
  while (!ended()) {
    lock.unlock();
    const bool helped = jobs.help();
    lock.lock();
    if (!helped) changed.wait_for(lock, kBetweenHelps, ended);
  }
}

}  // namespace sgm
