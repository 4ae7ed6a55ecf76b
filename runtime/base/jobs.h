#pragma once
// The job system that a runtime receives from the host program or makes itself: all parallel computation of the library
// runs on it. The library has no other threads, except those that wait for a store on a server (stream/world_core.h)
// and one that compiles shaders.
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

/// Contract of an implementation: submit() must run the function exactly once, but is free in when and where: at once,
/// later, on any thread, in any order, or only within help(). The submitted functions throw no exceptions. The library
/// never waits for a job that has not started: the waiting thread does that job's work itself, and the job finds no
/// work left when it runs. help() runs one queued job, if any, on the calling thread, and returns whether it ran one.
class JobSystem {
 public:
  virtual ~JobSystem() = default;
  virtual unsigned concurrency() const = 0;  ///< maximum number of concurrent workers, including the caller's thread;
                                             ///< at least 1
  virtual void submit(void (*function)(void*), void* argument, int priority) = 0;
  virtual bool help() = 0;
};

/// Makes a job system with threads of its own. workers = 0 means one for each processor. If the system cannot start all
/// threads, the pool uses those that started, and concurrency() counts only these. The threads are named "sgm worker 1"
/// and so on for the profiler; `names`, a short string of static lifetime, replaces "sgm worker". Errors if no thread
/// starts: limit, out_of_memory.
Result<std::unique_ptr<JobSystem>> makeThreadPool(unsigned workers, const Profiler& profiler = {},
                                                  const char* names = "sgm worker");

/// Runs body(i) for i in [0, count) on the job system and on the calling thread; returns when all calls have ended. If
/// a body throws an exception, no further iteration starts, and parallelFor() rethrows the exception when all running
/// iterations have ended.
void parallelFor(JobSystem& jobs, size_t count, const std::function<void(size_t)>& body);

/// Blocks until ended() is true, and runs queued jobs on the calling thread meanwhile, because the job system may have
/// no other thread to run them. The lock protects the state that ended() reads; `changed` must be notified when that
/// state changes.
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
