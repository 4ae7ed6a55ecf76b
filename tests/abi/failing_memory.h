#pragma once
// Simulates memory that runs out at a chosen allocation: in the allocator that the caller provides, or in the whole
// program's heap (memory_test.cpp).

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

/// An allocator that fails after `left` successful allocations: the next `failures` allocations fail, by default all.
struct Failing {
  std::atomic<int64_t> left{INT64_MAX};
  std::atomic<int64_t> failures{INT64_MAX};
  std::atomic<int64_t> live{0};

  static void* allocate(void* user, size_t size, size_t alignment) {
    auto& f = *static_cast<Failing*>(user);
    if (const int64_t at = f.left.fetch_sub(1); at <= 0 && at > -f.failures) return nullptr;
    void* memory = ::operator new (size, std::align_val_t{alignment}, std::nothrow);
    if (memory != nullptr) f.live.fetch_add(1);
    return memory;
  }
  static void release(void* user, void* memory, size_t, size_t alignment) {
    static_cast<Failing*>(user)->live.fetch_sub(1);
    ::operator delete (memory, std::align_val_t{alignment});
  }
};

/// Number of C++ heap allocations that still succeed on this thread; all later ones fail. Below 0: none fails.
inline thread_local int64_t heap_left = -1;
/// heap_left_everywhere: number of allocations, on all threads together, that still succeed; heap_failures: number of
/// allocations after these that fail.
inline std::atomic<int64_t> heap_left_everywhere{INT64_MAX}, heap_failures{INT64_MAX};

inline void* heapAllocate(size_t size, size_t alignment) {
  if (heap_left >= 0 && heap_left-- == 0) {
    heap_left = 0;
    return nullptr;
  }
  if (heap_left_everywhere.load() < INT64_MAX / 2) {
    if (const int64_t at = heap_left_everywhere.fetch_sub(1); at <= 0 && at > -heap_failures) return nullptr;
  }
  const size_t rounded = (std::max<size_t>(size, 1) + alignment - 1) / alignment * alignment;
  return alignment <= alignof(std::max_align_t) ? std::malloc(rounded) : std::aligned_alloc(alignment, rounded);
}
