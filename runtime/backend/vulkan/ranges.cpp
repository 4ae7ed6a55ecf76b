#include "backend/vulkan/ranges.h"

#include <iterator>

namespace sgm::vulkan {

Ranges::Ranges(uint64_t size, uint64_t granule) : granule_(granule) {
  ranges_.emplace(0, Range{size, {}});
  gaps_.emplace(size, 0);
}

std::optional<uint64_t> Ranges::take(uint64_t bytes) {
  const uint64_t rounded = (bytes + granule_ - 1) & ~(granule_ - 1);
  const auto gap = gaps_.lower_bound({rounded, 0});
  if (gap == gaps_.end()) return std::nullopt;
  const auto [whole, offset] = *gap;
  const auto taken = ranges_.find(offset);
  if (whole > rounded) {
    const auto rest = gaps_.emplace(whole - rounded, offset + rounded).first;
    try {
      ranges_.emplace_hint(std::next(taken), offset + rounded, Range{whole - rounded, {}});
    } catch (...) {
      gaps_.erase(rest);
      throw;
    }
  }
  taken->second.bytes = rounded;
  taken->second.gap = gaps_.extract(gap);
  return offset;
}

void Ranges::give(uint64_t offset) noexcept {
  auto it = ranges_.find(offset);
  Gaps::node_type gap = std::move(it->second.gap);
  if (const auto next = std::next(it); next != ranges_.end() && !next->second.taken()) {
    gaps_.erase({next->second.bytes, next->first});
    it->second.bytes += next->second.bytes;
    ranges_.erase(next);
  }
  if (it != ranges_.begin()) {
    if (const auto previous = std::prev(it); !previous->second.taken()) {
      gaps_.erase({previous->second.bytes, previous->first});
      previous->second.bytes += it->second.bytes;
      ranges_.erase(it);
      it = previous;
    }
  }
  gap.value() = {it->second.bytes, it->first};
  gaps_.insert(std::move(gap));
}

}  // namespace sgm::vulkan
