#pragma once
// The job system that a runtime receives or makes: all parallel computation of the library runs on it. The library's
// other threads only wait for a store on a server (stream/world_core.h), and one compiles shaders.
//
// concurrency() includes the calling thread: at most that many threads, the caller among them, work on a loop or batch
// concurrently. A thread pool of N workers therefore starts N - 1 threads, but at least one, so that batches run even
// if no thread waits for them.

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
/// run it exactly once. The submitted functions throw no exceptions. The library never waits for a job that has not
/// started: the waiting thread does that job's work, and the job finds no work left when it runs. help() runs one
/// waiting job, if any, on the calling thread, and returns whether it ran one.
class JobSystem {
 public:
  virtual ~JobSystem() = default;
  virtual unsigned concurrency() const = 0;  ///< concurrent workers including the caller's thread, at least 1
  virtual void submit(void (*function)(void*), void* argument, int priority) = 0;
  virtual bool help() = 0;
};

/// Makes a job system with threads of its own. workers = 0 means one for each processor. If the system cannot start all
/// of the threads, the pool uses those that started, and concurrency() counts them. The profiler receives their names,
/// "sgm worker 1" and so on; `names`, short and of static lifetime, replaces "sgm worker". Errors if no thread starts:
/// limit, out_of_memory.
Result<std::unique_ptr<JobSystem>> makeThreadPool(unsigned workers, const Profiler& profiler = {},
                                                  const char* names = "sgm worker");

/// Runs body(i) for i in [0, count) on the job system and returns when all calls have ended; the caller's thread works
/// too. After a body has thrown an exception no further body starts, and the exception is rethrown here when all
/// running bodies have ended.
void parallelFor(JobSystem& jobs, size_t count, const std::function<void(size_t)>& body);

/// Blocks until ended() is true. The lock protects the state that ended() reads, and `changed` must be notified when
/// that state changes. Meanwhile this function runs waiting jobs, because the job system may have no other thread to
/// run them.
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
