#pragma once
// Memory from the system, with a pool of large blocks: the default of a runtime whose caller supplies no allocator.

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "sgm/sgm.h"

namespace sgm::api {

/// Returns an allocator that uses malloc and free.
sgm_allocator systemAllocator();

/// Reuses large blocks. malloc returns large blocks to the system and gets new ones from it, page by page. For a mesh
/// of a million triangles, that takes half as long as meshing, and threads wait for each other there. So released
/// blocks are stored here for the next request of their size; all of them are freed if the system runs out of memory.
/// Thread-safe.
class KeptBlocks {
 public:
  /// Allocates from `system`, whose user pointer must outlive this object.
  explicit KeptBlocks(const sgm_allocator& system = systemAllocator()) : system_(system) {}
  KeptBlocks(const KeptBlocks&) = delete;
  KeptBlocks& operator=(const KeptBlocks&) = delete;
  ~KeptBlocks();

  static constexpr size_t kSmallest = size_t{1} << 14;  ///< minimum size of a block that is stored for reuse, in bytes
  static constexpr size_t kLargest = size_t{1} << 26;
  /// Limit for all stored blocks in bytes. Beyond it, blocks of the size that was unused for longest are freed first.
  static constexpr size_t kMost = size_t{1} << 27;

  /// Same as the functions of sgm_allocator.
  void* allocate(size_t size, size_t alignment);
  void release(void* memory, size_t size, size_t alignment);

  /// Returns the total size of the blocks that are stored now.
  size_t bytes();

  /// Returns these functions as a table, which must not be used after this object is destroyed.
  sgm_allocator allocator();

 private:
  static constexpr size_t kSteps = 8;  ///< number of size classes from one power of two to the next
  static constexpr size_t kSizes = 12 * kSteps + 1;
  static_assert(kSmallest << (kSizes / kSteps) == kLargest);

  /// The stored blocks of one size class, the most recent last. The most recent one is used first: it is most likely in
  /// cache.
  struct Shelf {
    std::vector<void*> blocks;
    uint64_t used = 0;  ///< value of clock_ at the last use
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
  size_t bytes_ = 0;  ///< total size of all stored blocks
};

}  // namespace sgm::api
