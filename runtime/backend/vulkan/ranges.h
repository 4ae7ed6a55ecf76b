#pragma once
// Which bytes of a block are taken.

#include <cstdint>
#include <map>
#include <optional>

namespace sgm::vulkan {

/// Best fit over [0, size); every range begins and ends on a multiple of the granule. One thread at a time.
class Ranges {
 public:
  /// granule: a power of two; size: a multiple of it, not 0.
  Ranges(uint64_t size, uint64_t granule);

  /// Where the range begins; none where no gap is long enough. bytes: not 0. Looks at every range there is: a block has
  /// hundreds at most. Throws std::bad_alloc, and has changed nothing then.
  std::optional<uint64_t> take(uint64_t bytes);
  /// What take gave.
  void give(uint64_t offset) noexcept;

  bool empty() const { return ranges_.size() == 1 && !ranges_.begin()->second.taken; }

 private:
  struct Range {
    uint64_t bytes;
    bool taken;
  };
  uint64_t granule_;
  std::map<uint64_t, Range> ranges_;  // by offset, without gaps; no two neighbours are both free
};

}  // namespace sgm::vulkan
