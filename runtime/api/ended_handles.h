#pragma once
// The head in front of every handle. Its memory stays allocated for a while after the handle is destroyed, so that
// destroying the handle twice is detected.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <mutex>

struct sgm_runtime;

namespace sgm::api {

/// The head lies directly before its handle, so that it can be found from any kind of handle. Aligned for all kinds.
struct alignas(std::max_align_t) HandleHead {
  sgm_runtime& runtime;
  size_t size;                        ///< bytes of head and handle together
  std::atomic<uint32_t> owners{1};    ///< number of owners; 0: the handle is destroyed
  HandleHead* ended_after = nullptr;  ///< the next handle in the list of destroyed ones
};

/// The maximum size of head and handle together. The public header states it as the memory that a destroyed handle
/// holds.
inline constexpr size_t kMaxHandleSize = 512;

/// Adds an owner. Returns false, and changes nothing, if the handle is destroyed.
bool gainOwner(HandleHead& head) noexcept;

/// Removes an owner. Returns the previous number of owners: if it is 1, the caller must destroy the handle; if it is 0,
/// the handle was already destroyed, and nothing changes.
uint32_t loseOwner(HandleHead& head) noexcept;

/// The most recently destroyed handles of a runtime, without their content. They form an intrusive list, so that
/// destroying a handle needs no memory and cannot fail. Thread-safe.
class EndedHandles {
 public:
  static constexpr size_t kMost = 1024;

  explicit EndedHandles(std::pmr::memory_resource* memory) : memory_(memory) {}
  EndedHandles(const EndedHandles&) = delete;
  EndedHandles& operator=(const EndedHandles&) = delete;
  ~EndedHandles();

  /// Takes ownership of the memory of a destroyed handle. Frees the oldest one if there are too many.
  void add(HandleHead* head) noexcept;
  /// Returns the bytes of the runtime's memory that the destroyed handles hold.
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
