#pragma once
// Arrays that are filled once: those that handles of meshes keep, and large scratch.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory_resource>
#include <type_traits>
#include <utility>

#include "base/large_pages.h"

namespace sgm {

/// Memory that is written once, without being cleared first, in large pages: meshes are large.
template <class T>
class RawArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit RawArray(std::pmr::memory_resource* memory) : pages_(memory) {}
  RawArray(RawArray&& other) noexcept : pages_(other.pages_), data_(other.data_), size_(other.size_) {
    other.data_ = nullptr;
    other.size_ = 0;
  }
  RawArray(const RawArray&) = delete;
  RawArray& operator=(const RawArray&) = delete;
  RawArray& operator=(RawArray&&) = delete;
  ~RawArray() {
    if (data_ != nullptr) pages_.deallocate(data_, size_);
  }

  /// Once, on an empty array. Throws std::bad_alloc.
  void allocate(size_t size) {
    if (size == 0) return;
    data_ = pages_.allocate(size);
    size_ = size;
  }
  /// Room for at least `size`; the first `used` elements stay. Grows to the double, so that many calls copy little.
  /// Throws std::bad_alloc, and is as before then.
  void grow(size_t used, size_t size) {
    if (size <= size_) return;
    RawArray larger(pages_.resource());
    larger.allocate(std::max(size, 2 * size_));
    if (used > 0) std::memcpy(larger.data_, data_, used * sizeof(T));
    std::swap(data_, larger.data_);
    std::swap(size_, larger.size_);
  }
  T* data() { return data_; }
  const T* data() const { return data_; }
  size_t size() const { return size_; }

 private:
  LargePages<T> pages_;
  T* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace sgm
