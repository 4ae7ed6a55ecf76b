#pragma once
// An engine's thread pool: runs jobs by priority; jobs of equal priority in the order of submission.

#include <sgm/sgm.h>

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

/// Must outlive the runtime that submits jobs to it. The destructor runs all waiting jobs, then joins the threads.
class EngineJobs {
 public:
  explicit EngineJobs(unsigned threads) {
    while (threads_.size() < threads) threads_.emplace_back([this] { work(); });
  }
  EngineJobs(const EngineJobs&) = delete;
  EngineJobs& operator=(const EngineJobs&) = delete;
  ~EngineJobs() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  sgm_job_system table() {
    // The result is the number of worker threads plus one, because the thread that calls the library works too.
    return {[](void* user) { return static_cast<uint32_t>(static_cast<EngineJobs*>(user)->threads_.size() + 1); },
            [](void* user, void (*function)(void*), void* argument, int32_t priority) -> int32_t {
              return static_cast<EngineJobs*>(user)->submit({function, argument, priority, 0}) ? 1 : 0;
            },
            [](void* user) -> int32_t { return static_cast<EngineJobs*>(user)->runOne() ? 1 : 0; }, this};
  }

  size_t jobsRun() const {
    const std::lock_guard lock(mutex_);
    return run_;
  }

 private:
  struct Job {
    void (*function)(void*);
    void* argument;
    int32_t priority;
    uint64_t number;
  };
  static bool later(const Job& a, const Job& b) {
    return a.priority != b.priority ? a.priority < b.priority : a.number > b.number;
  }

  /// Returns false if there is no memory to queue the job: the library then runs the job itself. Throws no exception.
  bool submit(Job job) noexcept {
    try {
      const std::lock_guard lock(mutex_);
      job.number = next_number_++;
      waiting_.push_back(job);
      std::push_heap(waiting_.begin(), waiting_.end(), later);
    } catch (const std::bad_alloc&) {
      return false;
    }
    wake_.notify_one();
    return true;
  }

  bool runOne() {
    std::unique_lock lock(mutex_);
    if (waiting_.empty()) return false;
    runNext(lock);
    return true;
  }

  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      runNext(lock);
    }
  }

  void runNext(std::unique_lock<std::mutex>& lock) {
    std::pop_heap(waiting_.begin(), waiting_.end(), later);
    const Job job = waiting_.back();
    waiting_.pop_back();
    ++run_;
    lock.unlock();
    job.function(job.argument);
    lock.lock();
  }

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Job> waiting_;  ///< a heap; its first element is the next job
  uint64_t next_number_ = 0;
  size_t run_ = 0;
  bool ending_ = false;
  std::vector<std::thread> threads_;
};
