#pragma once
// Marching cubes over a caller's grid of floats, of any size: quantised, triangulated and welded as chunks are, with
// normals from the grid's own gradient.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "base/jobs.h"
#include "base/result.h"

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

/// A grid that the caller owns; the checks of sgm_grid_desc have been made.
struct GridSamples {
  const float* values = nullptr;
  std::array<size_t, 3> size{};       ///< samples
  size_t stride_y = 0, stride_z = 0;  ///< floats
  double cell = 1;
  bool normals = true;
};

struct GridMesh {
  RawArray<float> positions, normals;               ///< three a vertex
  RawArray<uint32_t> indices;                       ///< three a triangle
  std::array<float, 3> bounds_min{}, bounds_max{};  ///< of the positions; 0 where there is none

  explicit GridMesh(std::pmr::memory_resource* memory) : positions(memory), normals(memory), indices(memory) {}
};

/// Vertices and triangles come in the order of mesh/body.h, whatever the job system does. A vertex on an edge lies at a
/// whole 256th of the cell; the normal there is the gradient interpolated between the edge's two samples.
/// Errors: invalid_argument where a value is not finite, limit where the mesh passes 2^32 - 1 vertices or 2^32 - 1
/// indices.
Result<GridMesh> meshGrid(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory);

}  // namespace sgm::api
