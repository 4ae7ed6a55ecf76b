#pragma once
// Which bytes of a block are taken.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace sgm::vulkan {

/// Best fit over [0, size); every range begins and ends on a multiple of the granule. One thread at a time.
class Ranges {
 public:
  /// granule: a power of two; size: a multiple of it, not 0.
  Ranges(uint64_t size, uint64_t granule);

  /// Where the range begins: in the shortest gap that is long enough, of those the first; none where there is none.
  /// bytes: not 0. Takes as long as the logarithm of how many ranges there are. Throws std::bad_alloc, and has changed
  /// nothing then.
  std::optional<uint64_t> take(uint64_t bytes);
  /// What take gave.
  void give(uint64_t offset) noexcept;

  bool empty() const { return ranges_.size() == 1 && gaps_.size() == 1; }

 private:
  using Gaps = std::set<std::pair<uint64_t, uint64_t>>;  // bytes, offset
  struct Range {
    uint64_t bytes;
    Gaps::node_type gap;  // while the range is taken; to give it back needs no memory then
    bool taken() const { return !gap.empty(); }
  };
  uint64_t granule_;
  std::map<uint64_t, Range> ranges_;  // by offset, without holes; no two neighbours are both free
  Gaps gaps_;                         // the free ones
};

}  // namespace sgm::vulkan
