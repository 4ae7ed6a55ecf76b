#pragma once
// A memory resource that runs out on request.

#include <atomic>
#include <cstdint>
#include <memory_resource>
#include <new>

namespace sgm {

/// Memory that fails after `until` allocations: the next `failures` allocations throw std::bad_alloc.
class Failing final : public std::pmr::memory_resource {
 public:
  std::atomic<int64_t> until = INT64_MAX, failures = 0, live = 0;
  std::atomic<int64_t> failed = 0;

 private:
  void* do_allocate(size_t size, size_t alignment) override {
    if (--until < 0 && --failures >= 0) {
      ++failed;
      throw std::bad_alloc();
    }
    ++live;
    return std::pmr::new_delete_resource()->allocate(size, alignment);
  }
  void do_deallocate(void* memory, size_t size, size_t alignment) override {
    --live;
    std::pmr::new_delete_resource()->deallocate(memory, size, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

}  // namespace sgm
