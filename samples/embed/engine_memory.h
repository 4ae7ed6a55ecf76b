#pragma once
// An engine's allocator with a budget, which counts the memory that the library uses.

#include <sgm/sgm.h>

#include <atomic>
#include <cstddef>
#include <new>

/// Must outlive the runtime that allocates from it.
class EngineMemory {
 public:
  explicit EngineMemory(size_t budget) : budget_(budget) {}

  sgm_allocator table() {
    return {[](void* user, size_t size, size_t alignment) {
              return static_cast<EngineMemory*>(user)->allocate(size, alignment);
            },
            [](void* user, void* memory, size_t size, size_t alignment) {
              static_cast<EngineMemory*>(user)->release(memory, size, alignment);
            },
            this};
  }

  size_t live() const { return live_; }
  size_t peak() const { return peak_; }
  size_t blocks() const { return blocks_; }  ///< number of allocations that have not been freed

 private:
  /// Returns null if the budget is exhausted. The library then reports SGM_ERR_OUT_OF_MEMORY, or continues with less
  /// memory if it can.
  void* allocate(size_t size, size_t alignment) {
    const size_t live = live_.fetch_add(size) + size;
    void* memory = live <= budget_ ? ::operator new (size, std::align_val_t{alignment}, std::nothrow) : nullptr;
    if (memory == nullptr) {
      live_ -= size;
      return nullptr;
    }
    ++blocks_;
    for (size_t peak = peak_; live > peak && !peak_.compare_exchange_weak(peak, live);) {
    }
    return memory;
  }
  void release(void* memory, size_t size, size_t alignment) {
    ::operator delete (memory, std::align_val_t{alignment});
    --blocks_;
    live_ -= size;
  }

  const size_t budget_;
  std::atomic<size_t> live_{0}, peak_{0}, blocks_{0};
};
