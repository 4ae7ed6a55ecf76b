#include "backend/vulkan/ranges.h"

#include <iterator>

namespace sgm::vulkan {

Ranges::Ranges(uint64_t size, uint64_t granule) : granule_(granule) { ranges_.emplace(0, Range{size, false}); }

std::optional<uint64_t> Ranges::take(uint64_t bytes) {
  const uint64_t rounded = (bytes + granule_ - 1) & ~(granule_ - 1);
  auto best = ranges_.end();
  for (auto it = ranges_.begin(); it != ranges_.end(); ++it) {
    if (it->second.taken || it->second.bytes < rounded) continue;
    if (best == ranges_.end() || it->second.bytes < best->second.bytes) best = it;
  }
  if (best == ranges_.end()) return std::nullopt;
  if (best->second.bytes > rounded) {
    ranges_.emplace_hint(std::next(best), best->first + rounded, Range{best->second.bytes - rounded, false});
  }
  best->second = {rounded, true};
  return best->first;
}

void Ranges::give(uint64_t offset) noexcept {
  auto it = ranges_.find(offset);
  it->second.taken = false;
  if (const auto next = std::next(it); next != ranges_.end() && !next->second.taken) {
    it->second.bytes += next->second.bytes;
    ranges_.erase(next);
  }
  if (it == ranges_.begin()) return;
  if (const auto previous = std::prev(it); !previous->second.taken) {
    previous->second.bytes += it->second.bytes;
    ranges_.erase(it);
  }
}

}  // namespace sgm::vulkan
