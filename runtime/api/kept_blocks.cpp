#include "api/kept_blocks.h"

#include <bit>
#include <new>

#include "base/large_pages.h"

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

}  // namespace

sgm_allocator systemAllocator() { return {systemAllocate, systemRelease, nullptr}; }

/// Returns the number of a block's size class. A class spans an eighth of a power of two, so that a block can be reused
/// for nearly equal sizes. A block smaller than its class never touches the pages at its end, so these cost no physical
/// memory.
size_t KeptBlocks::numberOf(size_t size) {
  const auto octave = static_cast<size_t>(std::bit_width(size - 1)) - 1;  // 2^octave < size <= 2^(octave + 1)
  const size_t step = (size_t{1} << octave) / kSteps;
  const size_t steps = (size - (size_t{1} << octave) + step - 1) / step;
  return (octave - static_cast<size_t>(std::countr_zero(kSmallest))) * kSteps + steps;
}
size_t KeptBlocks::capacityOf(size_t number) {
  const size_t octave = kSmallest << number / kSteps;
  return octave + octave / kSteps * (number % kSteps);
}
size_t KeptBlocks::alignmentOf(size_t capacity) { return capacity >= kLargePage ? kLargePage : 64; }
bool KeptBlocks::keeps(size_t size, size_t alignment) {
  return size > kSmallest && size <= kLargest && alignment <= alignmentOf(capacityOf(numberOf(size)));
}

void* KeptBlocks::fromSystem(size_t size, size_t alignment) {
  if (void* memory = system_.allocate(system_.user, size, alignment)) return memory;
  // The request must not fail as long as the pool holds unused blocks: free all of them, and try again.
  dropAll();
  return system_.allocate(system_.user, size, alignment);
}

void KeptBlocks::toSystem(void* memory, size_t size, size_t alignment) {
  system_.release(system_.user, memory, size, alignment);
}

void KeptBlocks::drop(Shelf& shelf, size_t capacity) {
  void* memory = shelf.blocks.back();
  shelf.blocks.pop_back();
  bytes_ -= capacity;
  ASAN_UNPOISON_MEMORY_REGION(memory, capacity);
  toSystem(memory, capacity, alignmentOf(capacity));
}

void KeptBlocks::dropAll() {
  const std::lock_guard lock(mutex_);
  for (size_t i = 0; i < kSizes; ++i) {
    while (!shelves_[i].blocks.empty()) drop(shelves_[i], capacityOf(i));
  }
}

void KeptBlocks::makeRoom() {
  while (bytes_ > kMost) {
    size_t oldest = kSizes;
    for (size_t i = 0; i < kSizes; ++i) {
      if (!shelves_[i].blocks.empty() && (oldest == kSizes || shelves_[i].used < shelves_[oldest].used)) oldest = i;
    }
    drop(shelves_[oldest], capacityOf(oldest));
  }
}

KeptBlocks::~KeptBlocks() { dropAll(); }

void* KeptBlocks::allocate(size_t size, size_t alignment) {
  if (!keeps(size, alignment)) return fromSystem(size, alignment);
  const size_t number = numberOf(size), capacity = capacityOf(number);
  {
    const std::lock_guard lock(mutex_);
    Shelf& shelf = shelves_[number];
    shelf.used = ++clock_;
    if (!shelf.blocks.empty()) {
      void* memory = shelf.blocks.back();
      shelf.blocks.pop_back();
      bytes_ -= capacity;
      ASAN_UNPOISON_MEMORY_REGION(memory, capacity);
      return memory;
    }
  }
  return fromSystem(capacity, alignmentOf(capacity));
}

void KeptBlocks::release(void* memory, size_t size, size_t alignment) {
  if (!keeps(size, alignment)) return toSystem(memory, size, alignment);
  const size_t number = numberOf(size), capacity = capacityOf(number);
  const std::lock_guard lock(mutex_);
  try {
    shelves_[number].blocks.push_back(memory);
  } catch (const std::bad_alloc&) {
    return toSystem(memory, capacity, alignmentOf(capacity));
  }
  ASAN_POISON_MEMORY_REGION(memory, capacity);
  bytes_ += capacity;
  makeRoom();
}

size_t KeptBlocks::bytes() {
  const std::lock_guard lock(mutex_);
  return bytes_;
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
