#pragma once
// Switches a world to another field, one field at a time, however fast new fields arrive.
//
//   engine's thread     want()
//   jobs                compare(): finds the differences (field_change.h), some chunks at a time
//   then                the change goes to the world's edits, and the planner takes it up like a brush
//
// The next switch waits until the previous field is drawn. If chunks for a moving viewer are still to be meshed then,
// it waits as long again as the previous switch took, so that an animation leaves them half of the time. Before the
// first drawn frame, only one switch happens; otherwise a world that is animated from the start would never appear. If
// a field cannot be drawn, the world returns to the previous field, so that edits and queries match the drawn one.
// Without viewers nothing is drawn, and all switches wait.

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "base/jobs.h"
#include "stream/edits/field_change.h"
#include "stream/edits/world_edits.h"
#include "stream/plan/drawn_frame.h"

namespace sgm {

/// Thread-safe, except that calls of compare() must not run concurrently.
class FieldSwitch {
 public:
  /// sharp: the world's chunks have sharp features.
  explicit FieldSwitch(bool sharp = false) : sharp_(sharp) {}

  /// Requests a switch. If several requests are waiting, only the last one is carried out.
  void want(std::shared_ptr<const WorldField> next);

  /// True if no comparison is running and, if `viewed`, no switch is waiting or unfinished. viewed: there are viewers.
  bool settled(bool viewed) const;
  /// True if a job is comparing fields, or is about to, because begin() returned true.
  bool busy() const;

  /// Numbers of want() calls, counted from 1: that of the last call, and that of the call whose field is drawn (0: the
  /// first field of the world).
  struct Turn {
    uint64_t wanted = 0, drawn = 0;
  };
  Turn turn() const;

  struct Progress {
    uint64_t drawn = 0;    ///< number of the drawn state
    uint64_t failed = 0;   ///< number of a state that cannot be drawn
    bool viewed = false;   ///< there are viewers
    bool shown = false;    ///< a frame has been drawn
    bool at_rest = false;  ///< true if all that the viewers need is drawn
  };
  /// Returns true if a job should call compare(). After that it returns false until compare() returns, or giveUp() is
  /// called.
  bool begin(const Progress& progress);

  /// Does the work of one job. Returns true if begin() should be called again soon. Throws std::bad_alloc; the
  /// comparison of the same field then starts again later.
  bool compare(const std::shared_ptr<const DrawnFrame>& drawn, WorldEdits& edits, JobSystem& jobs);
  /// Reports that the job of a successful begin() could not be submitted.
  void giveUp();

 private:
  using Clock = std::chrono::steady_clock;

  const bool sharp_;

  bool compareSome(const DrawnFrame& drawn, WorldEdits& edits, JobSystem& jobs);

  // Used by compare() only.
  std::shared_ptr<const WorldField> from_, to_;
  std::shared_ptr<const FieldChange> change_;  ///< the comparison in progress; null: none
  std::vector<ChunkKey> left_;                 ///< chunks that are still to be compared

  mutable std::mutex mutex_;  ///< guards the following members
  std::shared_ptr<const WorldField> next_;
  /// set if the last field failed: the field to return to, which takes precedence over all requests
  std::shared_ptr<const WorldField> back_;
  std::shared_ptr<const WorldField> before_;  ///< the field before the open change
  Turn turn_;
  uint64_t turn_begun_ = 0;  ///< turn (want() call) of the open change
  bool going_back_ = false;  ///< true if the field being compared was back_
  bool comparing_ = false;   ///< true if a job compares fields, or is about to
  bool open_ = false;        ///< true if a change is in progress or not drawn yet
  /// number of the state that the open change led to; 0: the comparison is still in progress
  uint64_t state_ = 0;
  Clock::time_point begun_, not_before_;
};

}  // namespace sgm
