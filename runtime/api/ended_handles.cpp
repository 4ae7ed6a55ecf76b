#include "api/ended_handles.h"

#include <utility>

// The memory of destroyed handles is not freed at once, so AddressSanitizer alone would not detect that it is used. It
// is therefore poisoned.
#if defined(__SANITIZE_ADDRESS__)
#define SGM_WATCHES_ADDRESSES 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SGM_WATCHES_ADDRESSES 1
#endif
#endif
#if defined(SGM_WATCHES_ADDRESSES)
#include <sanitizer/asan_interface.h>
#define SGM_FORBID(address, size) __asan_poison_memory_region(address, size)
#define SGM_ALLOW(address, size) __asan_unpoison_memory_region(address, size)
#else
#define SGM_FORBID(address, size) static_cast<void>(0)
#define SGM_ALLOW(address, size) static_cast<void>(0)
#endif

namespace sgm::api {

bool gainOwner(HandleHead& head) noexcept {
  uint32_t owners = head.owners.load(std::memory_order_relaxed);
  do {
    if (owners == 0) return false;
  } while (!head.owners.compare_exchange_weak(owners, owners + 1, std::memory_order_relaxed));
  return true;
}

uint32_t loseOwner(HandleHead& head) noexcept {
  uint32_t owners = head.owners.load(std::memory_order_relaxed);
  do {
    if (owners == 0) return 0;
  } while (
      !head.owners.compare_exchange_weak(owners, owners - 1, std::memory_order_acq_rel, std::memory_order_relaxed));
  return owners;
}

EndedHandles::~EndedHandles() {
  while (oldest_ != nullptr) free(std::exchange(oldest_, oldest_->ended_after));
}

void EndedHandles::add(HandleHead* head) noexcept {
  SGM_FORBID(head + 1, head->size - sizeof(HandleHead));
  bytes_.fetch_add(head->size, std::memory_order_relaxed);
  HandleHead* forgotten = nullptr;
  {
    const std::lock_guard lock(mutex_);
    (newest_ == nullptr ? oldest_ : newest_->ended_after) = head;
    newest_ = head;
    if (count_ == kMost) {
      forgotten = std::exchange(oldest_, oldest_->ended_after);
    } else {
      ++count_;
    }
  }
  if (forgotten != nullptr) free(forgotten);
}

void EndedHandles::free(HandleHead* head) noexcept {
  const size_t size = head->size;
  SGM_ALLOW(head + 1, size - sizeof(HandleHead));
  bytes_.fetch_sub(size, std::memory_order_relaxed);
  memory_->deallocate(head, size, alignof(HandleHead));
}

}  // namespace sgm::api
