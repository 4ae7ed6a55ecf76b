#pragma once
// Numbers the chunks of a box in an order in which layers of chunks can be processed one after another with little
// memory.

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/fixed.h"

namespace sgm {

/// Numbers chunks along the shortest axis first and along the longest one last, so that layers have as few chunks as
/// possible. Axes of equal length keep the order x, y, z. A chunk's number grows with each of its coordinates.
class ChunkOrder {
 public:
  /// counts: number of chunks along each axis, above 0.
  explicit ChunkOrder(Int3 counts) : counts_(counts) {
    std::stable_sort(axes_.begin(), axes_.end(), [&](int a, int b) { return counts[a] < counts[b]; });
  }

  Int3 counts() const { return counts_; }
  uint64_t size() const { return along(0) * along(1) * along(2); }
  /// Returns the coordinates of the chunk with this number, counted from the lowest chunk.
  Int3 at(uint64_t number) const {
    Int3 chunk;
    for (const int axis : axes_) {
      const auto count = static_cast<uint64_t>(counts_[axis]);
      chunk[axis] = static_cast<int32_t>(number % count);
      number /= count;
    }
    return chunk;
  }
  uint64_t numberOf(Int3 chunk) const {
    return place(chunk, 0) + along(0) * (place(chunk, 1) + along(1) * place(chunk, 2));
  }

  /// Returns the difference between the numbers of two chunks that are neighbours along this axis.
  uint64_t stride(int axis) const { return axis == axes_[0] ? 1 : axis == axes_[1] ? along(0) : along(0) * along(1); }

 private:
  uint64_t along(size_t i) const { return static_cast<uint64_t>(counts_[axes_[i]]); }
  uint64_t place(Int3 chunk, size_t i) const { return static_cast<uint64_t>(chunk[axes_[i]]); }

  Int3 counts_;
  std::array<int, 3> axes_{0, 1, 2};  ///< the axes, shortest first
};

}  // namespace sgm
