#pragma once
// The header that precedes every handle in memory. The memory of a destroyed handle stays allocated for a while, so
// that the library can detect if the handle is destroyed a second time.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <mutex>

struct sgm_runtime;

namespace sgm::api {

/// The header lies directly before its handle, so that it can be found from a handle of any type. Aligned for all
/// types.
struct alignas(std::max_align_t) HandleHead {
  sgm_runtime& runtime;
  size_t size;                        ///< size in bytes of header and handle together
  std::atomic<uint32_t> owners{1};    ///< number of owners; 0 if the handle is destroyed
  HandleHead* ended_after = nullptr;  ///< next element of the list of destroyed handles
};

/// Maximum size in bytes of header and handle together. It limits the memory that destroyed handles occupy, which sgm.h
/// documents.
inline constexpr size_t kMaxHandleSize = 512;

/// Adds an owner. Returns false, without any change, if the handle is already destroyed.
bool gainOwner(HandleHead& head) noexcept;

/// Removes an owner. Returns the previous number of owners. If it was 1, the caller must destroy the handle; if it was
/// 0, the handle was already destroyed, and nothing changes.
uint32_t loseOwner(HandleHead& head) noexcept;

/// The memory of a runtime's most recently destroyed handles; their contents are already freed. An intrusive list, so
/// that destroying a handle needs no memory and cannot fail. Thread-safe.
class EndedHandles {
 public:
  static constexpr size_t kMost = 1024;

  explicit EndedHandles(std::pmr::memory_resource* memory) : memory_(memory) {}
  EndedHandles(const EndedHandles&) = delete;
  EndedHandles& operator=(const EndedHandles&) = delete;
  ~EndedHandles();

  /// Takes ownership of a destroyed handle's memory. If the list is full, frees the memory of the oldest handle.
  void add(HandleHead* head) noexcept;
  /// Returns the number of bytes that destroyed handles still occupy.
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
