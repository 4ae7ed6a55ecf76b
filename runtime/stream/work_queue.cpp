#include "stream/work_queue.h"

#include <algorithm>
#include <array>

namespace sgm {

bool WorkQueue::isReady(const WorkItem& item, Clock::time_point now) const {
  // What was edited is in no store.
  if (!is_far_ || item.rank == WorkItem::Rank::edited) return true;
  return (item.look != nullptr && item.look->has_ended) || now - item.in_sight_since >= kPatience;
}

void WorkQueue::replace(std::vector<WorkItem>& items, bool is_same_state, Clock::time_point now) noexcept {
  items_.swap(items);
  if (!is_far_) return;
  const auto inSight = [](std::vector<WorkItem>& of) { return std::span(of).last(std::min(kSight, of.size())); };
  std::array<WorkItem*, kSight> before{};
  const std::span<WorkItem> seen = inSight(items);
  std::transform(seen.begin(), seen.end(), before.begin(), [](WorkItem& item) { return &item; });
  const auto end = before.begin() + static_cast<ptrdiff_t>(seen.size());
  const auto keyOf = [](const WorkItem* item) { return item->request.key; };
  std::ranges::sort(before.begin(), end, {}, keyOf);
  for (WorkItem& item : inSight(items_)) {
    const auto at = std::ranges::lower_bound(before.begin(), end, item.request.key, {}, keyOf);
    const bool is_known = at != end && (*at)->request.key == item.request.key;
    item.in_sight_since = is_known ? (*at)->in_sight_since : now;
    if (is_known && is_same_state && (*at)->request == item.request) item.look = (*at)->look;
  }
}

std::optional<size_t> WorkQueue::nextReady(size_t below, Clock::time_point now) const {
  for (size_t at = below; at > items_.size() - sight(); --at) {
    if (isReady(items_[at - 1], now)) return at - 1;
  }
  return std::nullopt;
}

size_t WorkQueue::countReady(Clock::time_point now) const {
  if (!is_far_) return items_.size();
  return static_cast<size_t>(std::count_if(items_.end() - static_cast<ptrdiff_t>(sight()), items_.end(),
                                           [&](const WorkItem& item) { return isReady(item, now); }));
}

WorkItem WorkQueue::remove(size_t at, Clock::time_point now) {
  WorkItem item = std::move(items_[at]);
  if (item.look != nullptr && !item.look->has_ended) item.look = nullptr;
  items_.erase(items_.begin() + static_cast<ptrdiff_t>(at));
  // One more is in sight.
  if (is_far_ && items_.size() >= kSight) items_[items_.size() - kSight].in_sight_since = now;
  return item;
}

std::optional<ChunkRequest> WorkQueue::beginLook(const std::shared_ptr<Look>& look) {
  const auto end = items_.rbegin() + static_cast<ptrdiff_t>(sight());
  const auto next = std::find_if(items_.rbegin(), end, isToLook);
  if (!is_far_ || next == end) return std::nullopt;
  next->look = look;
  return next->request;
}

size_t WorkQueue::countToLook() const {
  if (!is_far_) return 0;
  return static_cast<size_t>(std::count_if(items_.end() - static_cast<ptrdiff_t>(sight()), items_.end(), isToLook));
}

}  // namespace sgm
