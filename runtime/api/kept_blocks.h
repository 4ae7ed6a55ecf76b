#pragma once
// The system's memory with its large blocks kept: what a runtime has without an allocator of the caller's.

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "sgm/sgm.h"

namespace sgm::api {

/// malloc gives large blocks back to the system and takes fresh ones from it, page by page: for a mesh of a million
/// triangles that takes as long as half of the meshing. So large blocks that are released wait here for the next of
/// their size. Thread-safe.
class KeptBlocks {
 public:
  KeptBlocks() = default;
  KeptBlocks(const KeptBlocks&) = delete;
  KeptBlocks& operator=(const KeptBlocks&) = delete;
  ~KeptBlocks();

  static constexpr size_t kSmallest = size_t{1} << 18;  ///< bytes of a block that is kept
  static constexpr size_t kMost = size_t{1} << 27;      ///< bytes that are kept in all: the oldest blocks go first

  /// As sgm_allocator's functions.
  void* allocate(size_t size, size_t alignment);
  void release(void* memory, size_t size, size_t alignment);

  /// These functions as a table; the object must outlive its use.
  sgm_allocator allocator();

 private:
  struct Block {
    void* memory;
    size_t capacity, alignment;
  };

  std::mutex mutex_;
  std::vector<Block> kept_;  ///< the oldest first
  size_t bytes_ = 0;         ///< of them
};

/// malloc and free.
sgm_allocator systemAllocator();

}  // namespace sgm::api
