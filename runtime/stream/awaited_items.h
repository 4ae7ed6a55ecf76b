#pragma once
// Requests of a plan that are looked for far away before a job meshes what was not found.
//
// No job waits for a server, and no chunk does for long: a server that is slow costs what it should have saved.

#include <array>
#include <chrono>
#include <optional>
#include <vector>

#include "stream/planner.h"

namespace sgm {

/// Whoever has it guards it.
class AwaitedItems {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr size_t kMostLookers = 4;  ///< threads that look, each for one item at a time
  /// Where nothing has come for so long, what is awaited is to be meshed.
  static constexpr std::chrono::milliseconds kPatience{200};

  /// A plan's, which take the place of all others; those are in `items` then. The most urgent is last. Who looks for
  /// one of the others does so in vain.
  void replace(std::vector<WorkItem>& items, Clock::time_point now) noexcept;
  size_t size() const { return waiting_.size() + lookers(); }
  bool empty() const { return size() == 0; }
  /// Whether one of that rank is awaited, or of one that comes before.
  bool hasUpTo(WorkItem::Rank rank) const;

  struct Looking {
    uint64_t number = 0;
    WorkItem item;
  };
  /// For the most urgent that nobody looks for yet. None where there is none.
  std::optional<Looking> look(Clock::time_point now) noexcept;
  /// Whoever looked has ended. Whether that is still awaited, which it is no more then.
  bool end(uint64_t number, Clock::time_point now) noexcept;

  /// Moves all to the end of `items`, in no order, where nothing has come for too long. Throws std::bad_alloc, having
  /// done nothing.
  bool giveUp(std::vector<WorkItem>& items, Clock::time_point now);

 private:
  size_t lookers() const;

  std::vector<WorkItem> waiting_;
  std::array<Looking, kMostLookers> looking_;  ///< without a number: nobody's
  uint64_t next_number_ = 1;
  size_t busy_ = 0;          ///< threads that look, those in vain included
  Clock::time_point since_;  ///< when one of them ended, or the first began
};

}  // namespace sgm
