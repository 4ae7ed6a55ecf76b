#pragma once
// The runtime handle: adapts the caller's memory, threads, log and profiler to internal interfaces, and counts the
// handles that exist.

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

/// Makes the caller's allocator a memory resource that counts bytes, enforces the limit, and throws std::bad_alloc.
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

/// Adapts the caller's job system. The destructor waits until every accepted job has run: even a job that has nothing
/// left to do may hold memory of the runtime.
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
  uint64_t waiting_ = 0;  ///< number of jobs that were accepted but have not finished
};

/// Converts a UTF-8 path from the caller; empty for null.
inline std::filesystem::path pathOf(const char* utf8) {
  return utf8 != nullptr ? std::filesystem::path(reinterpret_cast<const char8_t*>(utf8)) : std::filesystem::path();
}

/// The device backends of a runtime, shared by all its fields: opening one takes long, and it needs much memory.
struct DeviceBackends {
  std::mutex mutex;
  std::shared_ptr<Backend> vulkan, cuda, automatic;  ///< null until first requested
  /// true if `vulkan` uses an external device; true if `cuda` uses an external context
  bool external = false, external_context = false;
  bool none = false;  ///< true if the automatic choice has found no device
  /// The external device in whose memory CUDA stores meshes; null if there is none.
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

  sgm_allocator allocator;    ///< also frees the runtime itself, which contains `memory`
  sgm::api::KeptBlocks kept;  ///< used if the caller supplied no allocator
  sgm::api::CallerMemory memory;
  sgm::api::EndedHandles ended{&memory};
  sgm_log_sink sink{};
  sgm::Profiler profiler;
  std::unique_ptr<sgm::JobSystem> jobs;
  std::shared_ptr<sgm::PlanTurns> plan_turns;  ///< shared by all worlds of the runtime
  std::filesystem::path pipeline_folder;       ///< empty: pipelines are not cached
  sgm::api::DeviceBackends devices;
  std::atomic<uint64_t> children{0};
};

namespace sgm::api {

inline HandleHead& headOf(void* handle) { return static_cast<HandleHead*>(handle)[-1]; }

/// Creates a handle behind its head, in the runtime's memory. It is counted as a child of the runtime, and has one
/// owner. Throws std::bad_alloc and what the constructor throws.
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

/// Returns INVALID_ARGUMENT, and logs that `function` was called with a handle that was already destroyed.
sgm_result refuseEnded(const HandleHead& head, const char* function) noexcept;

/// Adds an owner to a handle; ignores null. If the handle is destroyed, returns INVALID_ARGUMENT and changes nothing.
inline sgm_result acquireHandle(void* handle, const char* function) noexcept {
  if (handle == nullptr || gainOwner(headOf(handle))) return SGM_OK;
  return refuseEnded(headOf(handle), function);
}

/// Removes an owner of a handle, and destroys the handle with its last owner; ignores null. If the handle is already
/// destroyed, returns INVALID_ARGUMENT and changes nothing. The content is freed at once, the memory of the handle
/// itself later (EndedHandles).
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
