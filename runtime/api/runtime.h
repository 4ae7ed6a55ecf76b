#pragma once
// The runtime handle: what the caller gave (memory, threads, log, profiler), adapted to our interfaces, and the count
// of children.

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <new>
#include <string>
#include <utility>

#include "api/ended_handles.h"
#include "api/kept_blocks.h"
#include "backend/backend.h"
#include "base/jobs.h"
#include "base/profile.h"
#include "sgm/sgm.h"
#include "stream/plan/plan_turns.h"

namespace sgm::vulkan {
struct BorrowedDevice;
}

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

/// A path that the caller gave in UTF-8; empty for null.
inline std::filesystem::path pathOf(const char* utf8) {
  return utf8 != nullptr ? std::filesystem::path(reinterpret_cast<const char8_t*>(utf8)) : std::filesystem::path();
}

/// Backends on devices, which all fields of a runtime share: opening one takes long, and its memory is large.
struct DeviceBackends {
  std::mutex mutex;
  std::shared_ptr<Backend> vulkan, cuda, automatic;  ///< null until asked for
  bool lent = false, lent_context = false;           ///< `vulkan`, `cuda` is the engine's
  bool none = false;                                 ///< `automatic` has found no device
  /// Where CUDA's meshes stay: lent with external memory; null: not.
  std::shared_ptr<const vulkan::BorrowedDevice> drawing;
};

}  // namespace sgm::api

struct sgm_runtime {
  sgm_runtime(const sgm_allocator& allocator_in, uint64_t limit, bool keeps_blocks)
      : allocator(allocator_in), memory(keeps_blocks ? kept.allocator() : allocator_in, limit) {}

  void log(sgm_log_level level, const char* message) const {
    if (sink.write != nullptr) sink.write(sink.user, level, message);
  }
  void log(sgm_log_level level, const std::string& message) const { log(level, message.c_str()); }

  sgm_allocator allocator;    ///< frees the runtime itself, which `memory` lies within
  sgm::api::KeptBlocks kept;  ///< where the caller gave no allocator
  sgm::api::CallerMemory memory;
  sgm::api::EndedHandles ended{&memory};
  sgm_log_sink sink{};
  sgm::Profiler profiler;
  std::unique_ptr<sgm::JobSystem> jobs;
  std::shared_ptr<sgm::PlanTurns> plan_turns;  ///< of all worlds
  std::filesystem::path pipeline_folder;       ///< empty: pipelines are not kept
  sgm::api::DeviceBackends devices;
  std::atomic<uint64_t> children{0};
};

namespace sgm::api {

inline HandleHead& headOf(void* handle) { return static_cast<HandleHead*>(handle)[-1]; }

/// A handle in the runtime's memory behind its head, counted as the runtime's child, with one owner. Throws
/// std::bad_alloc, and what the constructor throws.
template <class Handle, class... Arguments>
Handle* makeHandle(sgm_runtime& runtime, Arguments&&... arguments) {
  constexpr size_t kSize = sizeof(HandleHead) + sizeof(Handle);
  static_assert(alignof(Handle) <= alignof(HandleHead));
  static_assert(kSize <= kMostHandleSize);
  void* memory = runtime.memory.allocate(kSize, alignof(HandleHead));
  auto* head = new (memory) HandleHead{runtime, kSize};
  Handle* handle = nullptr;
  try {
    handle = new (head + 1) Handle(runtime, std::forward<Arguments>(arguments)...);
  } catch (...) {
    runtime.memory.deallocate(memory, kSize, alignof(HandleHead));
    throw;
  }
  runtime.children.fetch_add(1, std::memory_order_relaxed);
  return handle;
}

/// INVALID_ARGUMENT, and the log is told: the handle had ended before this function was called.
sgm_result refuseEnded(const HandleHead& head, const char* function) noexcept;

/// One more owner of a handle; null is nothing to do. INVALID_ARGUMENT, and nothing happens: it has ended.
inline sgm_result acquireHandle(void* handle, const char* function) noexcept {
  if (handle == nullptr || gainOwner(headOf(handle))) return SGM_OK;
  return refuseEnded(headOf(handle), function);
}

/// One owner of a handle less, which ends with its last; null is nothing to do. INVALID_ARGUMENT, and nothing happens:
/// it has ended. What it owned is freed at once, the handle itself once it is forgotten.
template <class Handle>
sgm_result releaseHandle(Handle* handle, const char* function) noexcept {
  if (handle == nullptr) return SGM_OK;
  HandleHead& head = headOf(handle);
  const uint32_t owners = loseOwner(head);
  if (owners == 0) return refuseEnded(head, function);
  if (owners > 1) return SGM_OK;
  sgm_runtime& runtime = head.runtime;
  handle->~Handle();
  runtime.ended.add(&head);
  runtime.children.fetch_sub(1, std::memory_order_release);
  return SGM_OK;
}

}  // namespace sgm::api
