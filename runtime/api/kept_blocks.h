#pragma once
// The default allocator of a runtime: takes memory from the system, and keeps released large blocks in a pool.

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "sgm/sgm.h"

namespace sgm::api {

/// Returns an allocator that uses the C++ heap (aligned operator new and delete).
sgm_allocator systemAllocator();

/// A pool that reuses large blocks. malloc returns a large block to the system and later gets a new one, page by page.
/// For a mesh of a million triangles this takes half as long as meshing, and threads wait for each other in the system.
/// The pool instead keeps released blocks for the next request of their size; all of them are freed if the system runs
/// out of memory. Thread-safe.
class KeptBlocks {
 public:
  /// system: the allocator for new blocks; its `user` pointer must outlive this object.
  explicit KeptBlocks(const sgm_allocator& system = systemAllocator()) : system_(system) {}
  KeptBlocks(const KeptBlocks&) = delete;
  KeptBlocks& operator=(const KeptBlocks&) = delete;
  ~KeptBlocks();

  static constexpr size_t kSmallest = size_t{1} << 14;  ///< minimum size of a block that is stored for reuse, in bytes
  static constexpr size_t kLargest = size_t{1} << 26;
  /// Maximum total size of kept blocks in bytes. Above it, blocks of the least recently used size class are freed.
  static constexpr size_t kMost = size_t{1} << 27;

  /// The functions of sgm_allocator (sgm.h), without `user`.
  void* allocate(size_t size, size_t alignment);
  void release(void* memory, size_t size, size_t alignment);

  /// Returns the total size in bytes of the blocks that are kept for reuse.
  size_t bytes();

  /// Returns a function table for this object. The table must not be used after this object is destroyed.
  sgm_allocator allocator();

 private:
  static constexpr size_t kSteps = 8;  ///< number of size classes per power of two
  static constexpr size_t kSizes = 12 * kSteps + 1;
  static_assert(kSmallest << (kSizes / kSteps) == kLargest);

  /// The kept blocks of one size class. The block that was released last is at the end and is reused first, because it
  /// is most likely still in the CPU cache.
  struct Shelf {
    std::vector<void*> blocks;
    uint64_t used = 0;  ///< value of clock_ when this size class was last used
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
  size_t bytes_ = 0;  ///< total size of all kept blocks in bytes
};

}  // namespace sgm::api
