#pragma once
// Allocates byte ranges within a block.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace sgm::vulkan {

/// A best-fit allocator over [0, size); every range begins and ends at a multiple of the granule. Not thread-safe.
class Ranges {
 public:
  /// granule: a power of two; size: a multiple of it, not 0.
  Ranges(uint64_t size, uint64_t granule);

  /// Returns the offset of a new range; nullopt if no gap is large enough. Takes the range from the smallest gap that
  /// is large enough; among gaps of equal size, from the one at the lowest offset. bytes: not 0. Takes time logarithmic
  /// in the number of ranges. Throws std::bad_alloc, without having changed anything.
  std::optional<uint64_t> take(uint64_t bytes);
  /// Frees a range that take() has returned.
  void give(uint64_t offset) noexcept;

  bool empty() const { return ranges_.size() == 1 && gaps_.size() == 1; }

 private:
  using Gaps = std::set<std::pair<uint64_t, uint64_t>>;  // gaps, as pairs of size in bytes and offset
  struct Range {
    uint64_t bytes;
    // the range's entry of gaps_, kept here while the range is taken, so that freeing it needs no memory
    Gaps::node_type gap;
    bool taken() const { return !gap.empty(); }
  };
  uint64_t granule_;
  std::map<uint64_t, Range> ranges_;  // all ranges by offset, without holes; two adjacent ranges are never both free
  Gaps gaps_;                         // the free ranges
};

}  // namespace sgm::vulkan
