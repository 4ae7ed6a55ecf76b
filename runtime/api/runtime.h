#pragma once
// The runtime handle: what the caller gave (memory, threads, log, profiler), adapted to our interfaces, and the count
// of children.

#include <atomic>
#include <condition_variable>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <new>
#include <string>
#include <utility>

#include "base/jobs.h"
#include "base/profile.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// The caller's allocator as a memory resource that counts, keeps to a limit, and throws std::bad_alloc.
class CallerMemory final : public std::pmr::memory_resource {
 public:
  CallerMemory(const sgm_allocator& allocator, uint64_t limit) : allocator_(allocator), limit_(limit) {}
  uint64_t live() const { return live_.load(std::memory_order_relaxed); }
  uint64_t peak() const { return peak_.load(std::memory_order_relaxed); }

 private:
  void* do_allocate(size_t size, size_t alignment) override;
  void do_deallocate(void* memory, size_t size, size_t alignment) override;
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  sgm_allocator allocator_;
  uint64_t limit_;
  std::atomic<uint64_t> live_{0}, peak_{0};
};

/// The caller's job system as ours. Ends only when every job that it accepted has run: a job that has nothing left to
/// do may still hold memory of the runtime's.
class CallerJobs final : public JobSystem {
 public:
  explicit CallerJobs(const sgm_job_system& jobs) : jobs_(jobs) {}
  CallerJobs(const CallerJobs&) = delete;
  CallerJobs& operator=(const CallerJobs&) = delete;
  ~CallerJobs() override;
  unsigned concurrency() const override;
  void submit(void (*function)(void*), void* argument, int priority) override;
  bool help() override;

 private:
  struct Accepted {
    CallerJobs* owner;
    void (*function)(void*);
    void* argument;
  };
  static void runAccepted(void* argument);

  sgm_job_system jobs_;
  std::mutex mutex_;
  std::condition_variable ended_;
  uint64_t waiting_ = 0;  ///< accepted and not ended
};

}  // namespace sgm::api

struct sgm_runtime {
  sgm_runtime(const sgm_allocator& allocator_in, uint64_t limit)
      : allocator(allocator_in), memory(allocator_in, limit) {}

  void log(sgm_log_level level, const std::string& message) const {
    if (sink.write != nullptr) sink.write(sink.user, level, message.c_str());
  }

  sgm_allocator allocator;  ///< frees the runtime itself, which `memory` lies within
  sgm::api::CallerMemory memory;
  sgm_log_sink sink{};
  sgm::Profiler profiler;
  std::unique_ptr<sgm::JobSystem> jobs;
  std::atomic<uint64_t> children{0};
};

namespace sgm::api {

/// A handle in the runtime's memory, counted as its child. Throws std::bad_alloc, and what the constructor throws.
template <class Handle, class... Arguments>
Handle* makeHandle(sgm_runtime& runtime, Arguments&&... arguments) {
  std::pmr::polymorphic_allocator<> allocator(&runtime.memory);
  Handle* handle = allocator.new_object<Handle>(runtime, std::forward<Arguments>(arguments)...);
  runtime.children.fetch_add(1, std::memory_order_relaxed);
  return handle;
}

/// Ends a handle; null is nothing to do.
template <class Handle>
void endHandle(Handle* handle) {
  if (handle == nullptr) return;
  sgm_runtime& runtime = handle->runtime;
  std::pmr::polymorphic_allocator<>(&runtime.memory).delete_object(handle);
  runtime.children.fetch_sub(1, std::memory_order_release);
}

}  // namespace sgm::api
