#include "stream/awaited_items.h"

#include <algorithm>

namespace sgm {

size_t AwaitedItems::lookers() const {
  return static_cast<size_t>(
      std::count_if(looking_.begin(), looking_.end(), [](const Looking& of) { return of.number != 0; }));
}

void AwaitedItems::replace(std::vector<WorkItem>& items, Clock::time_point now) noexcept {
  // Whoever keeps all threads busy is no sooner with these.
  if (busy_ == 0) since_ = now;
  waiting_.swap(items);
  for (Looking& of : looking_) of = {};
}

bool AwaitedItems::hasUpTo(WorkItem::Rank rank) const {
  if (!waiting_.empty() && waiting_.back().rank <= rank) return true;
  return std::any_of(looking_.begin(), looking_.end(),
                     [&](const Looking& of) { return of.number != 0 && of.item.rank <= rank; });
}

std::optional<AwaitedItems::Looking> AwaitedItems::look(Clock::time_point now) noexcept {
  const auto free = std::find_if(looking_.begin(), looking_.end(), [](const Looking& of) { return of.number == 0; });
  if (waiting_.empty() || free == looking_.end()) return std::nullopt;
  if (busy_++ == 0) since_ = now;
  *free = {next_number_++, std::move(waiting_.back())};
  waiting_.pop_back();
  return *free;
}

bool AwaitedItems::end(uint64_t number, Clock::time_point now) noexcept {
  --busy_;
  since_ = now;
  const auto at =
      std::find_if(looking_.begin(), looking_.end(), [&](const Looking& of) { return of.number == number; });
  if (at == looking_.end()) return false;
  *at = {};
  return true;
}

bool AwaitedItems::giveUp(std::vector<WorkItem>& items, Clock::time_point now) {
  if (empty() || now - since_ < kPatience) return false;
  items.reserve(items.size() + size());
  std::move(waiting_.begin(), waiting_.end(), std::back_inserter(items));
  waiting_.clear();
  for (Looking& of : looking_) {
    if (of.number != 0) items.push_back(std::move(of.item));
    of = {};
  }
  return true;
}

}  // namespace sgm
