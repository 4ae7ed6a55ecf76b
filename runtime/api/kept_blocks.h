#pragma once
// The system's memory with its larger blocks kept: what a runtime has without an allocator of the caller's.

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "sgm/sgm.h"

namespace sgm::api {

/// malloc and free.
sgm_allocator systemAllocator();

/// malloc gives large blocks back to the system and takes fresh ones from it, page by page: for a mesh of a million
/// triangles that takes as long as half of the meshing, and threads wait for each other there. So blocks that are
/// released wait here for the next of their size; all go where the system has no memory left. Thread-safe.
class KeptBlocks {
 public:
  /// Of memory from `system`, whose user outlives the object.
  explicit KeptBlocks(const sgm_allocator& system = systemAllocator()) : system_(system) {}
  KeptBlocks(const KeptBlocks&) = delete;
  KeptBlocks& operator=(const KeptBlocks&) = delete;
  ~KeptBlocks();

  static constexpr size_t kSmallest = size_t{1} << 14;  ///< bytes of a block that is kept
  static constexpr size_t kLargest = size_t{1} << 26;
  /// Bytes that are kept in all: of the size unused for longest first.
  static constexpr size_t kMost = size_t{1} << 27;

  /// As sgm_allocator's functions.
  void* allocate(size_t size, size_t alignment);
  void release(void* memory, size_t size, size_t alignment);

  /// Kept now.
  size_t bytes();

  /// These functions as a table; the object must outlive its use.
  sgm_allocator allocator();

 private:
  static constexpr size_t kSteps = 8;  ///< sizes between a power of two and the next
  static constexpr size_t kSizes = 12 * kSteps + 1;
  static_assert(kSmallest << (kSizes / kSteps) == kLargest);

  /// Blocks of one size, the newest last: that is the likeliest to be in cache.
  struct Shelf {
    std::vector<void*> blocks;
    uint64_t used = 0;  ///< when, by clock_
  };

  static size_t numberOf(size_t size);
  static size_t capacityOf(size_t number);
  static size_t alignmentOf(size_t capacity);
  static bool keeps(size_t size, size_t alignment);
  void* fromSystem(size_t size, size_t alignment);
  void toSystem(void* memory, size_t size, size_t alignment);
  void drop(Shelf& shelf, size_t capacity);
  void dropAll();
  void makeRoom();

  const sgm_allocator system_;
  std::mutex mutex_;
  std::array<Shelf, kSizes> shelves_;
  uint64_t clock_ = 0;
  size_t bytes_ = 0;  ///< of all that are kept
};

}  // namespace sgm::api
