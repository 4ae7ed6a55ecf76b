#pragma once
// How a world goes over to another field: one field after the other, however fast they come.
//
//   engine's thread     want()
//   jobs                compare(): what differs (field_change.h), some chunks at a time
//   then                the change goes to the world's edits, and the planner takes it up as it takes up a brush
//
// The next one waits until what came before is drawn; and where chunks are still to be meshed for a viewer that moves,
// as long again, so that an animation leaves half of the time to them.

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "base/jobs.h"
#include "stream/drawn_frame.h"
#include "stream/field_change.h"
#include "stream/world_edits.h"

namespace sgm {

/// Thread-safe; one compare() at a time.
class FieldSwitch {
 public:
  /// Of several that have not been begun the last one counts.
  void want(std::shared_ptr<const WorldField> next);

  /// Nothing is wanted or in the making.
  bool settled() const;

  struct Progress {
    uint64_t drawn = 0;    ///< the state that is drawn, or of which it is known that it cannot be
    bool viewed = false;   ///< somebody looks: otherwise nothing new will ever be drawn
    bool at_rest = false;  ///< all that viewers want is there
  };
  /// Whether a job should call compare(); then no other until it returns.
  bool begin(const Progress& progress);

  /// One job's work. Whether there is more, which begin() then tells again. Throws std::bad_alloc: the same field is
  /// begun anew.
  bool compare(const std::shared_ptr<const DrawnFrame>& drawn, WorldEdits& edits, JobSystem& jobs);
  /// What began could not be handed on.
  void giveUp();

 private:
  using Clock = std::chrono::steady_clock;

  bool compareSome(const DrawnFrame& drawn, WorldEdits& edits, JobSystem& jobs);

  // Of compare() alone.
  std::shared_ptr<const WorldField> to_;
  std::shared_ptr<const FieldChange> change_;  ///< null: none in the making
  std::vector<ChunkKey> left_;                 ///< to be compared yet

  mutable std::mutex mutex_;  ///< guards what follows
  std::shared_ptr<const WorldField> next_;
  bool comparing_ = false;  ///< a job has begun, or is about to
  bool open_ = false;       ///< a change is in the making, or not drawn yet
  uint64_t state_ = 0;      ///< that the last one led to
  Clock::time_point begun_, not_before_;
};

}  // namespace sgm
