#pragma once
// How a world goes over to another field: one field after the other, however fast they come.
//
//   engine's thread     want()
//   jobs                compare(): what differs (field_change.h), some chunks at a time
//   then                the change goes to the world's edits, and the planner takes it up as it takes up a brush
//
// The next one waits until what came before is drawn; and where chunks are still to be meshed for a viewer that moves,
// as long again, so that an animation leaves half of the time to them. Before anything is drawn only one field takes
// another's place, or a world that is animated from the start would never show. Of a field that cannot be drawn the
// world goes back to the one before, so that edits and queries are of what is drawn. Where nobody looks nothing is
// drawn, and all wait.

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "base/jobs.h"
#include "stream/edits/field_change.h"
#include "stream/edits/world_edits.h"
#include "stream/plan/drawn_frame.h"

namespace sgm {

/// Thread-safe; one compare() at a time.
class FieldSwitch {
 public:
  /// sharp: the world's chunks have sharp features.
  explicit FieldSwitch(bool sharp = false) : sharp_(sharp) {}

  /// Of several that have not been begun the last one counts.
  void want(std::shared_ptr<const WorldField> next);

  /// Nothing is in the making, and nothing wanted that somebody waits to see.
  bool settled(bool viewed) const;
  /// A job is comparing, or about to.
  bool busy() const;

  /// Calls of want(): how many there were, and of which the field is drawn, counted from 1; 0: the first field is.
  struct Turn {
    uint64_t wanted = 0, drawn = 0;
  };
  Turn turn() const;

  struct Progress {
    uint64_t drawn = 0;    ///< the state that is drawn
    uint64_t failed = 0;   ///< one that cannot be
    bool viewed = false;   ///< somebody looks
    bool shown = false;    ///< something has been drawn
    bool at_rest = false;  ///< all that viewers want is there
  };
  /// Whether a job should call compare(); then no other until it returns.
  bool begin(const Progress& progress);

  /// One job's work. True: begin() should be asked again soon. Throws std::bad_alloc: the same field is begun anew.
  bool compare(const std::shared_ptr<const DrawnFrame>& drawn, WorldEdits& edits, JobSystem& jobs);
  /// What began could not be handed on.
  void giveUp();

 private:
  using Clock = std::chrono::steady_clock;

  const bool sharp_;

  bool compareSome(const DrawnFrame& drawn, WorldEdits& edits, JobSystem& jobs);

  // Of compare() alone.
  std::shared_ptr<const WorldField> from_, to_;
  std::shared_ptr<const FieldChange> change_;  ///< null: none in the making
  std::vector<ChunkKey> left_;                 ///< to be compared yet

  mutable std::mutex mutex_;  ///< guards what follows
  std::shared_ptr<const WorldField> next_;
  std::shared_ptr<const WorldField> back_;    ///< where the last one failed: the field before it, which comes first
  std::shared_ptr<const WorldField> before_;  ///< the change that is open: what it starts from
  Turn turn_;
  uint64_t turn_begun_ = 0;  ///< of the change that is open
  bool going_back_ = false;  ///< what is compared was back_
  bool comparing_ = false;   ///< a job has begun, or is about to
  bool open_ = false;        ///< a change is in the making, or not drawn yet
  uint64_t state_ = 0;       ///< that it led to; 0: in the making
  Clock::time_point begun_, not_before_;
};

}  // namespace sgm
