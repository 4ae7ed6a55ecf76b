#include "failing_heap.h"

#include <atomic>
#include <climits>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> left{LONG_MAX};
std::atomic<bool> failing_for_good{false};
std::atomic<bool> failed{false};
thread_local bool spared = false;

void* allocate(size_t size) noexcept {
  if (!spared) {
    const long before = left.fetch_sub(1);
    if (before == 0 || (before < 0 && failing_for_good)) {
      failed = true;
      return nullptr;
    }
  }
  return std::malloc(size > 0 ? size : 1);
}

}  // namespace

void* operator new(size_t size) {
  if (void* memory = allocate(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }

namespace sgm {

void failHeap(long after, bool for_good) {
  failed = false;
  failing_for_good = for_good;
  left = after;
}

bool mendHeap() {
  left = LONG_MAX;
  failing_for_good = false;
  return failed;
}

void spareThisThread() { spared = true; }

}  // namespace sgm
