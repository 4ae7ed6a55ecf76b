#include "base/jobs.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <new>
#include <queue>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "base/share_priority.h"
#include "base/short_text.h"

namespace sgm {

namespace {

struct Job {
  void (*function)(void*);
  void* argument;
  int priority;
  uint64_t order;
  bool operator<(const Job& other) const {
    return priority != other.priority ? priority < other.priority : order > other.order;
  }
};

class ThreadPool final : public JobSystem {
 public:
  ThreadPool(const Profiler& profiler, const char* names) : profiler_(profiler), names_(names) {}
  /// Starts the pool's threads. Must be called once, before any other function. Returns an error if no thread starts.
  Result<void> start(unsigned workers) {
    const unsigned wanted = std::max(1u, workers - 1);
    try {
      threads_.reserve(wanted);
      while (threads_.size() < wanted) threads_.emplace_back([this, number = threads_.size() + 1] { work(number); });
    } catch (const std::system_error& e) {
      if (threads_.empty()) {
        return Error{Code::limit, std::string("no thread could be started (") + e.what() +
                                      "): raise the limits on processes and on address space"};
      }
    } catch (const std::bad_alloc&) {
      if (threads_.empty()) return Error{Code::out_of_memory, "out of memory"};
    }
    workers_ = threads_.size() < wanted ? static_cast<unsigned>(threads_.size()) + 1 : workers;
    return {};
  }
  ~ThreadPool() override {
    {
      std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& t : threads_) t.join();
  }
  unsigned concurrency() const override { return workers_; }
  void submit(void (*function)(void*), void* argument, int priority) override {
    {
      std::lock_guard lock(mutex_);
      queue_.push({function, argument, priority, next_order_++});
    }
    wake_.notify_one();
  }
  bool help() override {
    Job job;
    {
      std::lock_guard lock(mutex_);
      if (queue_.empty()) return false;
      job = queue_.top();
      queue_.pop();
    }
    job.function(job.argument);
    return true;
  }

 private:
  void work(size_t number) {
    ShortText<32> name;
    name.add(names_).add(" ").add(uint64_t{number});
    profiler_.nameThread(name.c_str());
    for (;;) {
      Job job;
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
        if (queue_.empty()) return;
        job = queue_.top();
        queue_.pop();
      }
      job.function(job.argument);
    }
  }

  const Profiler profiler_;
  const char* const names_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::priority_queue<Job> queue_;
  uint64_t next_order_ = 0;
  bool stopping_ = false;
  unsigned workers_ = 1;
  std::vector<std::thread> threads_;
};

// The state of one parallelFor() loop, shared by the caller and the jobs that it has submitted. A job may start long
// after parallelFor() has returned; such a job finds no iterations left.
struct ForState {
  const std::function<void(size_t)>* body;
  size_t count;
  std::atomic<size_t> next{0};
  std::atomic<size_t> active{0};
  std::mutex mutex;
  std::condition_variable done;
  std::exception_ptr error;

  void run() {
    active.fetch_add(1);
    for (size_t i; (i = next.fetch_add(1)) < count;) {
      try {
        (*body)(i);
      } catch (...) {
        std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
        next.store(count);
      }
    }
    if (active.fetch_sub(1) == 1) {
      std::lock_guard lock(mutex);
      done.notify_all();
    }
  }
};

void runShare(void* argument) noexcept {
  const std::unique_ptr<std::shared_ptr<ForState>> share(static_cast<std::shared_ptr<ForState>*>(argument));
  (*share)->run();
}

}  // namespace

Result<std::unique_ptr<JobSystem>> makeThreadPool(unsigned workers, const Profiler& profiler, const char* names) {
  if (workers == 0) workers = std::max(1u, std::thread::hardware_concurrency());
  auto pool = std::make_unique<ThreadPool>(profiler, names);
  if (Result<void> started = pool->start(workers); !started) return started.error();
  return std::unique_ptr<JobSystem>(std::move(pool));
}

void parallelFor(JobSystem& jobs, size_t count, const std::function<void(size_t)>& body) {
  if (count == 0) return;
  auto state = std::make_shared<ForState>();
  state->body = &body;
  state->count = count;
  const size_t helpers = std::min<size_t>(jobs.concurrency(), count) - 1;
  try {
    for (size_t i = 0; i < helpers; ++i) {
      auto share = std::make_unique<std::shared_ptr<ForState>>(state);
      jobs.submit(runShare, share.get(), kSharePriority);
      share.release();
    }
  } catch (const std::bad_alloc&) {
    // Memory to submit a further job is missing: continue with fewer threads. Do not throw, because the jobs that
    // are already submitted read the caller's `body`.
  }
  state->run();
  // All iterations have started. Iterations that other threads still run must end before the caller destroys the body.
  std::unique_lock lock(state->mutex);
  helpUntil(jobs, lock, state->done, [&state] { return state->active.load() == 0; });
  if (state->error) std::rethrow_exception(state->error);
}

}  // namespace sgm
