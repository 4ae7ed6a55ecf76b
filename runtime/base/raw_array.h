#pragma once
// Arrays whose elements are allocated without initialization and written once. Used for the arrays of mesh handles, and
// for large scratch memory.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory_resource>
#include <type_traits>
#include <utility>

#include "base/large_pages.h"

namespace sgm {

/// An array in large pages (large_pages.h). New elements are uninitialized, because clearing large meshes takes time.
template <class T>
class RawArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit RawArray(std::pmr::memory_resource* memory) : pages_(memory) {}
  RawArray(RawArray&& other) noexcept
      : pages_(other.pages_),
        data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        room_(std::exchange(other.room_, 0)) {}
  RawArray(const RawArray&) = delete;
  RawArray& operator=(const RawArray&) = delete;
  RawArray& operator=(RawArray&&) = delete;
  ~RawArray() {
    if (data_ != nullptr) pages_.deallocate(data_, room_);
  }

  /// Allocates the elements. Call once, on an empty array. Throws std::bad_alloc.
  void allocate(size_t size) {
    if (size == 0) return;
    data_ = pages_.allocate(size);
    size_ = room_ = size;
  }
  /// Enlarges the array to at least `size` elements and keeps the first `used` elements. The size at least doubles, so
  /// that repeated growth copies little. Throws std::bad_alloc and then leaves the array unchanged.
  void grow(size_t used, size_t size) {
    if (size > size_) resize(used, std::max(size, 2 * size_));
  }
  /// Moves the array to new memory of exactly `size` elements and keeps the first `used` elements; used <= size. Throws
  /// std::bad_alloc and then leaves the array unchanged.
  void resize(size_t used, size_t size) {
    RawArray other(pages_.resource());
    other.allocate(size);
    if (used > 0) std::memcpy(other.data_, data_, used * sizeof(T));
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(room_, other.room_);
  }
  /// Reduces the array to its first `size` elements, without freeing memory.
  void cut(size_t size) { size_ = std::min(size, size_); }
  T* data() { return data_; }
  const T* data() const { return data_; }
  size_t size() const { return size_; }

 private:
  LargePages<T> pages_;
  T* data_ = nullptr;
  size_t size_ = 0, room_ = 0;  ///< number of elements, and capacity in elements
};

}  // namespace sgm
