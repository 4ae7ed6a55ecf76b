#pragma once
// The arrays that handles of meshes keep.

#include <cstddef>
#include <memory_resource>

namespace sgm::api {

/// Memory that is written once, without being cleared first: meshes are large.
template <class T>
class RawArray {
 public:
  explicit RawArray(std::pmr::memory_resource* memory) : memory_(memory) {}
  RawArray(RawArray&& other) noexcept : memory_(other.memory_), data_(other.data_), size_(other.size_) {
    other.data_ = nullptr;
    other.size_ = 0;
  }
  RawArray(const RawArray&) = delete;
  RawArray& operator=(const RawArray&) = delete;
  RawArray& operator=(RawArray&&) = delete;
  ~RawArray() {
    if (data_ != nullptr) memory_->deallocate(data_, size_ * sizeof(T), alignof(T));
  }

  /// Once, on an empty array. Throws std::bad_alloc.
  void allocate(size_t size) {
    if (size == 0) return;
    data_ = static_cast<T*>(memory_->allocate(size * sizeof(T), alignof(T)));
    size_ = size;
  }
  T* data() { return data_; }
  const T* data() const { return data_; }
  size_t size() const { return size_; }

 private:
  std::pmr::memory_resource* memory_;
  T* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace sgm::api
