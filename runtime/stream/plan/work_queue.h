#pragma once
// What a world has planned to mesh, the most urgent first; and where stores are far away, when a request's turn comes.
//
// Then lookers, threads that may wait, look for the most urgent requests, and jobs mesh those that have been looked
// for. A request that has been among these for kPatience is meshed all the same, and where all lookers have been at the
// same for so long, so are all that nobody looks for: a server that is slow is to cost no more than it saves. Looks
// outlast the plan that asked for them.

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "chunk/chunk_part.h"
#include "stream/plan/planner.h"

namespace sgm {

/// Of one request, for what was baked. Whoever has the queue guards it.
struct Look {
  std::optional<FoundParts> found;
  double seconds = 0;
  bool has_ended = false;
};

/// Whoever has it guards it.
class WorkQueue {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPatience{200};
  /// So many of the most urgent requests are in sight: they are looked for, and wait for that.
  static constexpr size_t kSight = 256;
  /// No more is looked for where so many have been found, and no job has taken them: their memory counts nowhere else.
  static constexpr size_t kMostFound = 64;

  /// lookers: how many there are; 0: there is nothing to look for, and every request may be meshed at once.
  explicit WorkQueue(size_t lookers) : lookers_(lookers) {}

  bool empty() const { return items_.empty(); }
  size_t size() const { return items_.size(); }
  const WorkItem& operator[](size_t at) const { return items_[at]; }
  /// Precondition: there is one.
  const WorkItem& mostUrgent() const { return items_.back(); }

  /// A plan's requests, the most urgent last, in place of all others, which are in `items` then. Those that stay the
  /// same keep their looks, and all of a chunk how long they have waited: as long as somebody may look for them.
  void replace(std::vector<WorkItem>& items, bool may_look, Clock::time_point now) noexcept;

  /// The most urgent request that may be meshed, of those before this place. None: all of them wait.
  std::optional<size_t> nextReady(size_t below, Clock::time_point now) const;
  /// How many may be meshed.
  size_t countReady(Clock::time_point now) const;
  /// Who takes a request that is still being looked for does without.
  WorkItem remove(size_t at, Clock::time_point now);

  /// The most urgent request that nobody looks for; has the look from now on. None: there is nothing to look for.
  std::optional<ChunkRequest> beginLook(const std::shared_ptr<Look>& look, Clock::time_point now);
  /// Of one that was begun, whoever has it now.
  void endLook(Look& look, std::optional<FoundParts>&& found, double seconds, Clock::time_point now);
  /// How many there are to look for, and how many lookers do.
  size_t countToLook() const;
  size_t countLooking() const { return looking_; }

 private:
  size_t sight() const { return lookers_ != 0 ? std::min(kSight, items_.size()) : 0; }
  /// Whether no looker has begun or ended for so long, and all are at work.
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
