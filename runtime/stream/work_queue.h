#pragma once
// What a world has planned to mesh, the most urgent first; and where stores are far away, when a request's turn comes.
//
// Then threads that may wait look for the most urgent requests, and jobs mesh those that have been looked for. A
// request that has been among these for kPatience is meshed all the same: a server that is slow costs no more than it
// saves. Looks outlast the plan that asked for them.

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "stream/planner.h"

namespace sgm {

/// Of one request, for what was baked. Whoever has the queue guards it until it has ended.
struct Look {
  FoundParts found;
  double seconds = 0;
  bool has_ended = false;
};

/// Whoever has it guards it.
class WorkQueue {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPatience{200};
  /// So many of the most urgent requests are looked for; the others have to wait until they are among these.
  static constexpr size_t kSight = 256;

  /// is_far: otherwise there is nothing to look for, and every request may be meshed at once.
  explicit WorkQueue(bool is_far) : is_far_(is_far) {}

  bool empty() const { return items_.empty(); }
  size_t size() const { return items_.size(); }
  const WorkItem& operator[](size_t at) const { return items_[at]; }
  /// Precondition: there is one.
  const WorkItem& mostUrgent() const { return items_.back(); }

  /// A plan's requests, the most urgent last, in place of all others, which are in `items` then. Those that stay the
  /// same keep their looks where the state is the same that they are meshed under, and all of a chunk how long they
  /// wait.
  void replace(std::vector<WorkItem>& items, bool is_same_state, Clock::time_point now) noexcept;

  /// The most urgent request that may be meshed, of those before this place. None: all of them wait.
  std::optional<size_t> nextReady(size_t below, Clock::time_point now) const;
  /// How many may be meshed, of those in sight.
  size_t countReady(Clock::time_point now) const;
  /// Who takes a request that is still being looked for does without.
  WorkItem remove(size_t at, Clock::time_point now);

  /// The most urgent request that nobody looks for; has the look from now on. None: there is nothing to look for.
  std::optional<ChunkRequest> beginLook(const std::shared_ptr<Look>& look);
  /// How many there are to look for.
  size_t countToLook() const;

 private:
  size_t sight() const { return is_far_ ? std::min(kSight, items_.size()) : items_.size(); }
  bool isReady(const WorkItem& item, Clock::time_point now) const;
  static bool isToLook(const WorkItem& item) { return item.look == nullptr && item.rank != WorkItem::Rank::edited; }

  const bool is_far_;
  std::vector<WorkItem> items_;
};

}  // namespace sgm
