#pragma once
// Vectors whose resize() leaves new elements uninitialized; the caller then writes them in order.

#include <memory_resource>
#include <type_traits>
#include <utility>
#include <vector>

namespace sgm {

/// Allocates as std::pmr::polymorphic_allocator does, but leaves default-constructed elements uninitialized.
template <class T>
class RawAllocator : public std::pmr::polymorphic_allocator<T> {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using std::pmr::polymorphic_allocator<T>::polymorphic_allocator;
  template <class Other>
  RawAllocator(const RawAllocator<Other>& other) noexcept : std::pmr::polymorphic_allocator<T>(other.resource()) {}
  template <class Other>
  struct rebind {
    using other = RawAllocator<Other>;
  };
  /// As for std::pmr::polymorphic_allocator, a copy of a container allocates from the default memory resource.
  RawAllocator select_on_container_copy_construction() const { return {}; }

  template <class... Arguments>
  void construct(T* at, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) > 0) ::new (static_cast<void*>(at)) T(std::forward<Arguments>(arguments)...);
  }
};

/// A vector whose resize() leaves new elements uninitialized: write them before reading them.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace sgm
