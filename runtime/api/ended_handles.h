#pragma once
// What stands before every handle in memory, and outlives it for a while: who destroys a handle twice is told so.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <mutex>

struct sgm_runtime;

namespace sgm::api {

/// Stands directly before its handle, and so tells of it without knowing its kind. Aligned for any kind.
struct alignas(std::max_align_t) HandleHead {
  sgm_runtime& runtime;
  size_t size;                        ///< bytes of head and handle together
  std::atomic<uint32_t> owners{1};    ///< 0: the handle has ended
  HandleHead* ended_after = nullptr;  ///< the next one that ended
};

/// Of head and handle: what the header says that ended handles hold at most.
inline constexpr size_t kMostHandleSize = 512;

/// One more owner. False, and nothing happens: the handle has ended.
bool gainOwner(HandleHead& head) noexcept;

/// One owner less. Returns how many there were: with 1 the caller ends the handle; with 0 it had ended, and nothing
/// happens.
uint32_t loseOwner(HandleHead& head) noexcept;

/// The handles of a runtime that ended last, without what they owned. They form a list of their own, so that to end a
/// handle takes no memory and cannot fail. Thread-safe.
class EndedHandles {
 public:
  static constexpr size_t kMost = 1024;

  explicit EndedHandles(std::pmr::memory_resource* memory) : memory_(memory) {}
  EndedHandles(const EndedHandles&) = delete;
  EndedHandles& operator=(const EndedHandles&) = delete;
  ~EndedHandles();

  /// Takes over the memory of a handle that is destroyed, and gives back that of the oldest where there are too many.
  void add(HandleHead* head) noexcept;
  /// Held from memory.
  uint64_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  void free(HandleHead* head) noexcept;

  std::pmr::memory_resource* memory_;
  std::atomic<uint64_t> bytes_{0};
  std::mutex mutex_;
  HandleHead* oldest_ = nullptr;
  HandleHead* newest_ = nullptr;
  size_t count_ = 0;
};

}  // namespace sgm::api
