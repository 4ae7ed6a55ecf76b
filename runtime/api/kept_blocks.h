#pragma once
// System memory with a pool of large blocks: the default of a runtime without an allocator from the caller.

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "sgm/sgm.h"

namespace sgm::api {

/// malloc and free.
sgm_allocator systemAllocator();

/// malloc returns large blocks to the system and takes fresh ones from it, page by page. For a mesh of a million
/// triangles this takes half as long as meshing, and threads wait for each other there. So released blocks stay here
/// for the next use of their size; all are freed if the system runs out of memory. Thread-safe.
class KeptBlocks {
 public:
  /// Takes memory from `system`, whose user must outlive the object.
  explicit KeptBlocks(const sgm_allocator& system = systemAllocator()) : system_(system) {}
  KeptBlocks(const KeptBlocks&) = delete;
  KeptBlocks& operator=(const KeptBlocks&) = delete;
  ~KeptBlocks();

  static constexpr size_t kSmallest = size_t{1} << 14;  ///< least size of a kept block, bytes
  static constexpr size_t kLargest = size_t{1} << 26;
  /// Limit for all kept bytes; the size unused for longest is freed first.
  static constexpr size_t kMost = size_t{1} << 27;

  /// Like sgm_allocator's functions.
  void* allocate(size_t size, size_t alignment);
  void release(void* memory, size_t size, size_t alignment);

  /// The number of bytes kept now.
  size_t bytes();

  /// These functions as a table; the object must outlive its use.
  sgm_allocator allocator();

 private:
  static constexpr size_t kSteps = 8;  ///< size classes between a power of two and the next
  static constexpr size_t kSizes = 12 * kSteps + 1;
  static_assert(kSmallest << (kSizes / kSteps) == kLargest);

  /// Blocks of one size class, newest last: the newest is most likely in cache.
  struct Shelf {
    std::vector<void*> blocks;
    uint64_t used = 0;  ///< the clock_ at its last use
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
  size_t bytes_ = 0;  ///< of all kept blocks
};

}  // namespace sgm::api
