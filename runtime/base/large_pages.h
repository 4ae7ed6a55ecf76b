#pragma once
// Allocates memory for large arrays, such as the vertices of a mesh, in large pages.

#include <cstddef>
#include <memory_resource>
#include <new>
#include <type_traits>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace sgm {

inline constexpr size_t kLargePage = size_t{1} << 21;

/// An allocator that requests pages of 2 MB: page faults of small pages take longer than most of the work on the data,
/// and ten times as long on a virtual machine. It takes its memory from a memory resource, which must outlive the
/// allocator. If the system has no large pages, it behaves as std::pmr::polymorphic_allocator, except that moving a
/// container moves its memory resource, too.
template <class T>
class LargePages {
 public:
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  LargePages(std::pmr::memory_resource* memory = std::pmr::new_delete_resource()) : memory_(memory) {}
  template <class U>
  LargePages(const LargePages<U>& other) : memory_(other.resource()) {}

  T* allocate(size_t count) {
    if (count > static_cast<size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    const size_t bytes = count * sizeof(T);
    void* const memory = memory_->allocate(bytes, alignmentOf(bytes));
#ifdef MADV_HUGEPAGE
    // Only whole large pages are requested: a large page for the remainder would waste memory. If the system rejects
    // the request, the memory simply has small pages.
    if (bytes >= kLargePage) (void)madvise(memory, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, size_t count) {
    memory_->deallocate(memory, count * sizeof(T), alignmentOf(count * sizeof(T)));
  }

  std::pmr::memory_resource* resource() const { return memory_; }
  friend bool operator==(LargePages a, LargePages b) { return *a.memory_ == *b.memory_; }

 private:
  static size_t alignmentOf(size_t bytes) { return bytes >= kLargePage ? kLargePage : alignof(T); }

  std::pmr::memory_resource* memory_;
};

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace sgm
