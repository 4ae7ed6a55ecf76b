#include "api/kept_blocks.h"

#include <algorithm>
#include <bit>
#include <new>

#if __has_include(<sanitizer/asan_interface.h>)
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(memory, size)
#define ASAN_UNPOISON_MEMORY_REGION(memory, size)
#endif

namespace sgm::api {
namespace {

void* systemAllocate(void*, size_t size, size_t alignment) {
  return ::operator new (size, std::align_val_t{alignment}, std::nothrow);
}
void systemRelease(void*, void* memory, size_t, size_t alignment) {
  ::operator delete (memory, std::align_val_t{alignment});
}

/// What is taken for a size, so that nearly equal ones can follow each other: up to an eighth more. Pages that nobody
/// touches cost nothing.
size_t capacityOf(size_t size) {
  const size_t step = std::bit_floor(size) / 8;
  return (size + step - 1) / step * step;
}

}  // namespace

sgm_allocator systemAllocator() { return {systemAllocate, systemRelease, nullptr}; }

KeptBlocks::~KeptBlocks() {
  for (const Block& block : kept_) {
    ASAN_UNPOISON_MEMORY_REGION(block.memory, block.capacity);
    systemRelease(nullptr, block.memory, block.capacity, block.alignment);
  }
}

void* KeptBlocks::allocate(size_t size, size_t alignment) {
  if (size < kSmallest || size > kMost) return systemAllocate(nullptr, size, alignment);
  const size_t capacity = capacityOf(size);
  {
    const std::lock_guard lock(mutex_);
    // The newest is the likeliest to be in cache.
    const auto at = std::find_if(kept_.rbegin(), kept_.rend(), [&](const Block& block) {
      return block.capacity == capacity && block.alignment == alignment;
    });
    if (at != kept_.rend()) {
      void* memory = at->memory;
      kept_.erase(std::next(at).base());
      bytes_ -= capacity;
      ASAN_UNPOISON_MEMORY_REGION(memory, capacity);
      return memory;
    }
  }
  return systemAllocate(nullptr, capacity, alignment);
}

void KeptBlocks::release(void* memory, size_t size, size_t alignment) {
  const size_t capacity = size < kSmallest || size > kMost ? 0 : capacityOf(size);
  if (capacity == 0 || capacity > kMost) return systemRelease(nullptr, memory, size, alignment);
  const std::lock_guard lock(mutex_);
  try {
    kept_.push_back({memory, capacity, alignment});
  } catch (const std::bad_alloc&) {
    return systemRelease(nullptr, memory, size, alignment);
  }
  ASAN_POISON_MEMORY_REGION(memory, capacity);
  bytes_ += capacity;
  while (bytes_ > kMost) {
    const Block oldest = kept_.front();
    kept_.erase(kept_.begin());
    bytes_ -= oldest.capacity;
    ASAN_UNPOISON_MEMORY_REGION(oldest.memory, oldest.capacity);
    systemRelease(nullptr, oldest.memory, oldest.capacity, oldest.alignment);
  }
}

sgm_allocator KeptBlocks::allocator() {
  return {[](void* user, size_t size, size_t alignment) {
            return static_cast<KeptBlocks*>(user)->allocate(size, alignment);
          },
          [](void* user, void* memory, size_t size, size_t alignment) {
            static_cast<KeptBlocks*>(user)->release(memory, size, alignment);
          },
          this};
}

}  // namespace sgm::api
