#pragma once
// The queue of planned requests, most urgent first. With stores on a server, it also decides when a request may be
// meshed.
//
// With such stores, threads that may wait for a server (lookers) prefetch the most urgent requests, and jobs mesh the
// requests whose prefetch has ended. A request is also meshed if it has waited for its prefetch for kPatience. If no
// looker makes progress for that long, all requests without a prefetch may be meshed: a slow server must not cost more
// than it saves. Prefetches outlast the plan that requested them.

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "chunk/chunk_part.h"
#include "stream/plan/planner.h"

namespace sgm {

/// The prefetch of one request from baked stores. Guarded by the mutex of the queue's owner.
struct Look {
  std::optional<FoundParts> found;
  double seconds = 0;
  bool has_ended = false;
};

/// Guarded by the mutex of its owner.
class WorkQueue {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPatience{200};
  /// This many of the most urgent requests are prefetched, and wait for their prefetch.
  static constexpr size_t kSight = 256;
  /// No new prefetch begins while jobs have not taken this many results, because the memory of results is not counted
  /// elsewhere.
  static constexpr size_t kMaxFound = 64;

  /// lookers: number of threads that prefetch; 0: no prefetch, and every request may be meshed at once.
  explicit WorkQueue(size_t prefetchers) : prefetchers_(prefetchers) {}

  bool empty() const { return items_.empty(); }
  size_t size() const { return items_.size(); }
  const WorkItem& operator[](size_t at) const { return items_[at]; }
  /// Precondition: the queue is not empty.
  const WorkItem& mostUrgent() const { return items_.back(); }

  /// Replaces all requests by those of a plan, most urgent last; swaps the old ones into `items`. Unchanged requests
  /// keep their prefetches. If may_prefetch (prefetching is allowed), all requests of a chunk also keep its waiting
  /// time.
  void replace(std::vector<WorkItem>& items, bool may_prefetch, Clock::time_point now) noexcept;

  /// Returns the index of the most urgent request before `below` that may be meshed; nullopt if all of them wait.
  std::optional<size_t> nextReady(size_t below, Clock::time_point now) const;
  /// Returns the number of requests that may be meshed.
  size_t countReady(Clock::time_point now) const;
  /// Removes and returns a request. If its prefetch is still running, the result of the prefetch is dropped.
  WorkItem remove(size_t at, Clock::time_point now);

  /// Begins a prefetch for the most urgent request that has none; returns that request, or nullopt if there is nothing
  /// to prefetch.
  std::optional<ChunkRequest> beginLook(const std::shared_ptr<Look>& look, Clock::time_point now);
  /// Ends a prefetch; its request may have been removed or replaced since.
  void endLook(Look& look, std::optional<FoundParts>&& found, double seconds, Clock::time_point now);
  /// Returns the number of requests whose prefetch may begin; the second function, the number of lookers at work.
  size_t countToLook() const;
  size_t countLooking() const { return looking_; }

 private:
  size_t sight() const { return prefetchers_ != 0 ? std::min(kSight, items_.size()) : 0; }
  /// True if all lookers are at work, and none of them has begun or ended a prefetch for kPatience.
  bool isStalled(Clock::time_point now) const { return looking_ >= prefetchers_ && now - progress_ >= kPatience; }
  bool isReady(size_t at, Clock::time_point now) const;
  bool mayPrefetch() const;
  static bool isToLook(const WorkItem& item) { return item.look == nullptr && item.rank != WorkItem::Rank::edited; }

  const size_t prefetchers_;
  std::vector<WorkItem> items_;
  size_t looking_ = 0;
  Clock::time_point progress_;
};

}  // namespace sgm
