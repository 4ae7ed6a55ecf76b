#include "base/jobs.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <queue>
#include <thread>
#include <vector>

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
  explicit ThreadPool(unsigned threads) {
    threads_.reserve(threads);
    for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
  }
  ~ThreadPool() override {
    {
      std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& t : threads_) t.join();
  }
  unsigned concurrency() const override { return static_cast<unsigned>(threads_.size()); }
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
  void work() {
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

  std::mutex mutex_;
  std::condition_variable wake_;
  std::priority_queue<Job> queue_;
  uint64_t next_order_ = 0;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

// Shared by the caller and the jobs that it has submitted; one of those may run long after the call has returned, and
// then finds nothing left to do.
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

void runShare(void* argument) {
  const std::unique_ptr<std::shared_ptr<ForState>> share(static_cast<std::shared_ptr<ForState>*>(argument));
  (*share)->run();
}

}  // namespace

std::unique_ptr<JobSystem> makeThreadPool(unsigned threads) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  return std::make_unique<ThreadPool>(threads);
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
      jobs.submit(runShare, share.get(), 0);
      share.release();
    }
  } catch (const std::bad_alloc&) {
    // Fewer threads then: what was submitted already still reads the body, so this call must go on.
  }
  state->run();
  // Nothing is left to begin; what other threads have begun must end before the body goes away.
  std::unique_lock lock(state->mutex);
  state->done.wait(lock, [&] { return state->active.load() == 0; });
  if (state->error) std::rethrow_exception(state->error);
}

}  // namespace sgm
