#include "stream/plan/work_queue.h"

#include <array>
#include <span>

namespace sgm {

bool WorkQueue::isReady(size_t at, Clock::time_point now) const {
  const WorkItem& item = items_[at];
  // Edited chunks do not wait for a prefetch, because they must be drawn as soon as possible.
  if (prefetchers_ == 0 || item.rank == WorkItem::Rank::edited) return true;
  if (item.look != nullptr && item.look->has_ended) return true;
  if (item.look == nullptr && isStalled(now)) return true;
  return at >= items_.size() - sight() && now - item.in_sight_since >= kPatience;
}

void WorkQueue::replace(std::vector<WorkItem>& items, bool may_prefetch, Clock::time_point now) noexcept {
  items_.swap(items);
  if (prefetchers_ == 0) return;
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
    if (is_known && (*at)->request == item.request) item.look = (*at)->look;
    item.in_sight_since = is_known && (may_prefetch || item.look != nullptr) ? (*at)->in_sight_since : now;
  }
}

std::optional<size_t> WorkQueue::nextReady(size_t below, Clock::time_point now) const {
  if (prefetchers_ == 0) return below > 0 ? std::optional(below - 1) : std::nullopt;
  const size_t first = isStalled(now) ? 0 : items_.size() - sight();
  for (size_t at = below; at > first; --at) {
    if (isReady(at - 1, now)) return at - 1;
  }
  return std::nullopt;
}

size_t WorkQueue::countReady(Clock::time_point now) const {
  const size_t first = items_.size() - sight();
  size_t count = prefetchers_ == 0 || isStalled(now) ? first : 0;
  for (size_t at = first; at < items_.size(); ++at) count += isReady(at, now);
  return count;
}

WorkItem WorkQueue::remove(size_t at, Clock::time_point now) {
  const bool was_in_sight = at >= items_.size() - sight();
  WorkItem item = std::move(items_[at]);
  if (item.look != nullptr && !item.look->has_ended) item.look = nullptr;
  items_.erase(items_.begin() + static_cast<ptrdiff_t>(at));
  // After the removal, one more request is among the kSight most urgent ones, so its waiting time starts.
  if (was_in_sight && items_.size() >= kSight) items_[items_.size() - kSight].in_sight_since = now;
  return item;
}

bool WorkQueue::mayPrefetch() const {
  const auto isFound = [](const WorkItem& item) { return item.look != nullptr && item.look->has_ended; };
  const auto first = items_.end() - static_cast<ptrdiff_t>(sight());
  return static_cast<size_t>(std::count_if(first, items_.end(), isFound)) < kMaxFound;
}

std::optional<ChunkRequest> WorkQueue::beginLook(const std::shared_ptr<Look>& look, Clock::time_point now) {
  const auto end = items_.rbegin() + static_cast<ptrdiff_t>(sight());
  const auto next = std::find_if(items_.rbegin(), end, isToLook);
  if (next == end || !mayPrefetch()) return std::nullopt;
  next->look = look;
  ++looking_;
  progress_ = now;
  return next->request;
}

void WorkQueue::endLook(Look& look, std::optional<FoundParts>&& found, double seconds, Clock::time_point now) {
  look.found = std::move(found);
  look.seconds = seconds;
  look.has_ended = true;
  --looking_;
  progress_ = now;
}

size_t WorkQueue::countToLook() const {
  if (!mayPrefetch()) return 0;
  return static_cast<size_t>(std::count_if(items_.end() - static_cast<ptrdiff_t>(sight()), items_.end(), isToLook));
}

}  // namespace sgm
