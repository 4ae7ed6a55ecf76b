#pragma once
// Vectors of what a mesh has millions of.

#include <cstddef>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace sgm::measure {

/// Asks for pages of 2 MB: to touch small ones for the first time takes longer than most that is measured, on a virtual
/// machine ten times as long. Elsewhere, and where the system has none left, as std::allocator.
template <class T>
struct LargePages {
  using value_type = T;

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  T* allocate(size_t count) {
    if (count > static_cast<size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    const size_t bytes = count * sizeof(T);
    if (bytes < kLeast) return static_cast<T*>(::operator new(bytes));
    void* const memory = ::operator new (bytes, std::align_val_t{kPage});
#ifdef MADV_HUGEPAGE
    // The end keeps small pages: a whole one there would be memory that nobody uses. Refused, nothing is lost.
    (void)madvise(memory, bytes / kPage * kPage, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, size_t count) {
    if (count * sizeof(T) < kLeast) {
      ::operator delete(memory);
    } else {
      ::operator delete (memory, std::align_val_t{kPage});
    }
  }
  friend bool operator==(LargePages, LargePages) { return true; }

 private:
  static constexpr size_t kPage = size_t{1} << 21, kLeast = kPage;
};

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace sgm::measure
