#pragma once
// Switches a world to another field, one field at a time, however fast new fields arrive.
//
//   engine's thread     want()
//   jobs                compare(): finds the differences (field_change.h), some chunks at a time
//   then                the change goes to the world's edits, and the planner takes it up like a brush
//
// The next switch waits until the previous field is drawn. If chunks are still to be meshed for a moving viewer, it
// waits as long again, so that an animation leaves half of the time to them. Before the first drawn frame only one
// switch happens, since a world animated from the start would never appear otherwise. If a field cannot be drawn, the
// world returns to the previous field, so that edits and queries match the drawn one. Without viewers nothing is drawn,
// and all switches wait.

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "base/jobs.h"
#include "stream/edits/field_change.h"
#include "stream/edits/world_edits.h"
#include "stream/plan/drawn_frame.h"

namespace sgm {

/// Thread-safe, but only one compare() at a time.
class FieldSwitch {
 public:
  /// sharp: the world's chunks have sharp features.
  explicit FieldSwitch(bool sharp = false) : sharp_(sharp) {}

  /// Requests a switch. Of several requests that have not begun, the last one counts.
  void want(std::shared_ptr<const WorldField> next);

  /// Whether no comparison runs and, with viewers, no switch is requested or unfinished.
  bool settled(bool viewed) const;
  /// Whether a job is comparing or about to.
  bool busy() const;

  /// Numbers of want() calls, counted from 1: the last call, and the call whose field is drawn (0: the first field).
  struct Turn {
    uint64_t wanted = 0, drawn = 0;
  };
  Turn turn() const;

  struct Progress {
    uint64_t drawn = 0;    ///< number of the drawn state
    uint64_t failed = 0;   ///< number of a state that cannot be drawn
    bool viewed = false;   ///< there are viewers
    bool shown = false;    ///< a frame has been drawn
    bool at_rest = false;  ///< everything that the viewers want is drawn
  };
  /// Whether a job should call compare(). If so, this returns false until that call returns.
  bool begin(const Progress& progress);

  /// The work of one job. Returns true if begin() should be called again soon. Throws std::bad_alloc; then the same
  /// field is compared anew later.
  bool compare(const std::shared_ptr<const DrawnFrame>& drawn, WorldEdits& edits, JobSystem& jobs);
  /// Reports that the job of a successful begin() could not be submitted.
  void giveUp();

 private:
  using Clock = std::chrono::steady_clock;

  const bool sharp_;

  bool compareSome(const DrawnFrame& drawn, WorldEdits& edits, JobSystem& jobs);

  // Used only by compare().
  std::shared_ptr<const WorldField> from_, to_;
  std::shared_ptr<const FieldChange> change_;  ///< the comparison in progress, or null
  std::vector<ChunkKey> left_;                 ///< chunks still to be compared

  mutable std::mutex mutex_;  ///< guards what follows
  std::shared_ptr<const WorldField> next_;
  std::shared_ptr<const WorldField> back_;    ///< set if the last field failed: the field to return to, before all
                                              ///< others
  std::shared_ptr<const WorldField> before_;  ///< the field before the open change
  Turn turn_;
  uint64_t turn_begun_ = 0;  ///< turn of the open change
  bool going_back_ = false;  ///< the compared field was back_
  bool comparing_ = false;   ///< a job has begun, or is about to
  bool open_ = false;        ///< a change is in progress or not drawn yet
  uint64_t state_ = 0;       ///< the state it led to; 0: in progress
  Clock::time_point begun_, not_before_;
};

}  // namespace sgm
