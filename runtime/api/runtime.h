#pragma once
// The runtime handle: adapts the caller's allocator, job system, log and profiler to internal interfaces, and counts
// the handles that exist.

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

/// A memory resource on top of the caller's allocator. Counts bytes, enforces memory_limit, and throws std::bad_alloc
/// on failure.
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

/// Adapts the caller's job system. The destructor waits until every accepted job has run, because even a job without
/// remaining work may own memory of the runtime.
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
  uint64_t waiting_ = 0;  ///< number of jobs that were accepted and have not finished
};

/// Converts a UTF-8 path from the caller; empty for null.
inline std::filesystem::path pathOf(const char* utf8) {
  return utf8 != nullptr ? std::filesystem::path(reinterpret_cast<const char8_t*>(utf8)) : std::filesystem::path();
}

/// The device backends of a runtime, shared by all of its fields, because opening a device takes long and needs much
/// memory.
struct DeviceBackends {
  std::mutex mutex;
  std::shared_ptr<Backend> vulkan, cuda, automatic;  ///< backends that exist; null until first requested
  /// true if `vulkan` uses an external device, or `cuda` an external context
  bool external = false, external_context = false;
  bool none = false;  ///< true if a previous automatic choice has found no usable device
  /// external Vulkan device in whose memory CUDA stores meshes; null if there is none
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

  sgm_allocator allocator;    ///< also used to free the runtime itself, after its member `memory` is destroyed
  sgm::api::KeptBlocks kept;  ///< allocator for a runtime whose caller supplied none
  sgm::api::CallerMemory memory;
  sgm::api::EndedHandles ended{&memory};
  sgm_log_sink sink{};
  sgm::Profiler profiler;
  std::unique_ptr<sgm::JobSystem> jobs;
  std::shared_ptr<sgm::PlanTurns> plan_turns;  ///< schedules the planning jobs of all worlds of the runtime
  std::filesystem::path pipeline_folder;       ///< folder of the Vulkan pipeline cache; empty: no cache
  sgm::api::DeviceBackends devices;
  std::atomic<uint64_t> children{0};
};

namespace sgm::api {

inline HandleHead& headOf(void* handle) { return static_cast<HandleHead*>(handle)[-1]; }

/// Creates a handle, with a header before it, in the runtime's memory. Counts it as a child of the runtime. The handle
/// has one owner. Throws std::bad_alloc, and exceptions of the constructor.
template <class Handle, class... Arguments>
Handle* makeHandle(sgm_runtime& runtime, Arguments&&... arguments) {
  constexpr size_t kSize = sizeof(HandleHead) + sizeof(Handle);
  static_assert(alignof(Handle) <= alignof(HandleHead));
  static_assert(kSize <= kMaxHandleSize);
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

/// Logs that `function` was called with a handle that was already destroyed. Returns SGM_ERR_INVALID_ARGUMENT.
sgm_result refuseEnded(const HandleHead& head, const char* function) noexcept;

/// Adds an owner to a handle; ignores null. Returns SGM_ERR_INVALID_ARGUMENT, without any change, if the handle is
/// already destroyed.
inline sgm_result acquireHandle(void* handle, const char* function) noexcept {
  if (handle == nullptr || gainOwner(headOf(handle))) return SGM_OK;
  return refuseEnded(headOf(handle), function);
}

/// Removes an owner of a handle, and destroys the handle if it was the last one; ignores null. The content is freed
/// immediately, the memory of the handle itself later (EndedHandles). Returns SGM_ERR_INVALID_ARGUMENT, without any
/// change, if the handle is already destroyed.
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
