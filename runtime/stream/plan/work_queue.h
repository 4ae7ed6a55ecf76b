#pragma once
// The queue of planned requests, most urgent first; for stores on a server, also decides when a request may be meshed.
//
// With such stores lookers, threads that may wait, prefetch the most urgent requests, and jobs mesh the prefetched
// ones. A request is meshed without a prefetch after kPatience; if no looker makes progress for that long, so are all
// requests without one: a slow server must not cost more than it saves. Prefetches outlast the plan that asked for
// them.

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "chunk/chunk_part.h"
#include "stream/plan/planner.h"

namespace sgm {

/// The prefetch of one request from baked stores. Guarded by the queue's owner.
struct Look {
  std::optional<FoundParts> found;
  double seconds = 0;
  bool has_ended = false;
};

/// Guarded by its owner.
class WorkQueue {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPatience{200};
  /// This many of the most urgent requests are prefetched, and wait for that.
  static constexpr size_t kSight = 256;
  /// No new prefetch begins while this many results are not taken by jobs: their memory is not counted elsewhere.
  static constexpr size_t kMostFound = 64;

  /// lookers: their number; 0: no prefetch, and every request may be meshed at once.
  explicit WorkQueue(size_t lookers) : lookers_(lookers) {}

  bool empty() const { return items_.empty(); }
  size_t size() const { return items_.size(); }
  const WorkItem& operator[](size_t at) const { return items_[at]; }
  /// Precondition: the queue is not empty.
  const WorkItem& mostUrgent() const { return items_.back(); }

  /// Replaces all requests by a plan's, most urgent last; the old ones are swapped into `items`. Unchanged requests
  /// keep their prefetches, and all requests of a chunk keep its waiting time, as long as prefetching is allowed.
  void replace(std::vector<WorkItem>& items, bool may_look, Clock::time_point now) noexcept;

  /// The most urgent request before this index that may be meshed; nullopt if all of them wait.
  std::optional<size_t> nextReady(size_t below, Clock::time_point now) const;
  /// The number of requests that may be meshed.
  size_t countReady(Clock::time_point now) const;
  /// Removes a request. If its prefetch is still running, the result is not used.
  WorkItem remove(size_t at, Clock::time_point now);

  /// Assigns the prefetch to the most urgent request without one; nullopt if there is nothing to prefetch.
  std::optional<ChunkRequest> beginLook(const std::shared_ptr<Look>& look, Clock::time_point now);
  /// Ends a prefetch, whatever became of its request.
  void endLook(Look& look, std::optional<FoundParts>&& found, double seconds, Clock::time_point now);
  /// The number of requests to prefetch, and of lookers at work.
  size_t countToLook() const;
  size_t countLooking() const { return looking_; }

 private:
  size_t sight() const { return lookers_ != 0 ? std::min(kSight, items_.size()) : 0; }
  /// Whether all lookers are at work, and none has begun or ended for kPatience.
  bool isStalled(Clock::time_point now) const { return looking_ >= lookers_ && now - progress_ >= kPatience; }
  bool isReady(size_t at, Clock::time_point now) const;
  bool mayLook() const;
  static bool isToLook(const WorkItem& item) { return item.look == nullptr && item.rank != WorkItem::Rank::edited; }

  const size_t lookers_;
  std::vector<WorkItem> items_;
  size_t looking_ = 0;
  Clock::time_point progress_;
};

}  // namespace sgm
