#pragma once
// The queue of planned requests for chunks, sorted by urgency. If there are stores on a server, it also decides when a
// request may be meshed.
//
// In that case, separate threads (prefetchers), which may wait for a server, prefetch the most urgent requests; jobs
// mesh the requests whose prefetch has ended. A request is also meshed after it has waited for its prefetch for
// kPatience. If no prefetcher makes progress for that long, all requests without a prefetch may be meshed: a slow
// server must not cost more time than it saves. A prefetch may outlive the plan that requested it.

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

/// A queue of requests. Not thread-safe: guarded by a mutex of its owner.
class WorkQueue {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPatience{200};
  /// Number of the most urgent requests that are prefetched. Only these requests wait for their prefetch.
  static constexpr size_t kSight = 256;
  /// Maximum number of prefetch results that jobs have not taken yet; at this number, no prefetch begins. The memory of
  /// these results is not counted elsewhere.
  static constexpr size_t kMaxFound = 64;

  /// prefetchers: number of threads that prefetch; 0: nothing is prefetched, and every request may be meshed
  /// immediately.
  explicit WorkQueue(size_t prefetchers) : prefetchers_(prefetchers) {}

  bool empty() const { return items_.empty(); }
  size_t size() const { return items_.size(); }
  const WorkItem& operator[](size_t at) const { return items_[at]; }
  /// Returns the most urgent request. Precondition: the queue is not empty.
  const WorkItem& mostUrgent() const { return items_.back(); }

  /// Replaces all requests by those of a new plan, the most urgent last; the old ones are swapped into `items`.
  /// Unchanged requests keep their prefetches. If may_prefetch is true, a changed request of the same chunk keeps its
  /// waiting time.
  void replace(std::vector<WorkItem>& items, bool may_prefetch, Clock::time_point now) noexcept;

  /// Returns the index of the most urgent request below index `below` that may be meshed; nullopt if all of them wait
  /// for a prefetch.
  std::optional<size_t> nextReady(size_t below, Clock::time_point now) const;
  /// Returns the number of requests that may be meshed now.
  size_t countReady(Clock::time_point now) const;
  /// Removes and returns the request at index `at`. If its prefetch is still running, the result will be dropped.
  WorkItem remove(size_t at, Clock::time_point now);

  /// Begins the prefetch of the most urgent request that has none. Returns this request; nullopt if there is nothing to
  /// prefetch. look: receives the result.
  std::optional<ChunkRequest> beginLook(const std::shared_ptr<Look>& look, Clock::time_point now);
  /// Ends a prefetch. Its request may have been removed or replaced in the meantime.
  void endLook(Look& look, std::optional<FoundParts>&& found, double seconds, Clock::time_point now);
  /// countToLook() returns the number of requests whose prefetch may begin; countLooking() the number of running
  /// prefetches.
  size_t countToLook() const;
  size_t countLooking() const { return looking_; }

 private:
  size_t sight() const { return prefetchers_ != 0 ? std::min(kSight, items_.size()) : 0; }
  /// True if all prefetchers are busy, and no prefetch has begun or ended for kPatience.
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
