#pragma once
// Replaces the field of a world, one field at a time, however fast new fields are requested.
//
//   engine's thread     want() requests a field
//   jobs                compare(): finds the differences (field_change.h), a limited number of chunks per job
//   then                the change is added to the world's edits, and the planner processes it like a brush
//
// The next switch begins when the field of the previous one is drawn. If chunks for a moving viewer still have to be
// meshed at that time, the next switch waits again as long as the previous switch took. So an animation leaves half of
// the time to these chunks. Before the first drawn frame, only one switch happens; otherwise a world that is animated
// from the start would never appear. If a field cannot be drawn, the world returns to the previous field, so that edits
// and queries match the drawn field. Without viewers nothing is drawn, and all switches wait.

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "base/jobs.h"
#include "stream/edits/field_change.h"
#include "stream/edits/world_edits.h"
#include "stream/plan/drawn_frame.h"

namespace sgm {

/// Schedules replacements of a world's field. Thread-safe, except that calls of compare() must not run concurrently.
class FieldSwitch {
 public:
  /// sharp: true if the world's chunks have sharp features.
  explicit FieldSwitch(bool sharp = false) : sharp_(sharp) {}

  /// Requests a switch to a field. If several requests are waiting, only the last request is carried out.
  void want(std::shared_ptr<const WorldField> next);

  /// True if no comparison is running. If there are viewers (`viewed`), also requires that no switch is waiting or
  /// unfinished.
  bool settled(bool viewed) const;
  /// True if begin() returned true, and the job that compares fields has not finished.
  bool busy() const;

  /// The calls of want() are numbered from 1. wanted: number of the last call. drawn: number of the call whose field is
  /// drawn; 0 for the world's first field.
  struct Turn {
    uint64_t wanted = 0, drawn = 0;
  };
  Turn turn() const;

  struct Progress {
    uint64_t drawn = 0;    ///< number of the drawn world state
    uint64_t failed = 0;   ///< number of a world state that cannot be drawn
    bool viewed = false;   ///< true if there are viewers
    bool shown = false;    ///< true if a frame has already been drawn
    bool at_rest = false;  ///< true if everything that the viewers need is drawn
  };
  /// Returns true if the caller must submit a job that calls compare(). After that it returns false until compare() has
  /// returned, or giveUp() is called.
  bool begin(const Progress& progress);

  /// Compares a limited number of chunks, as the work of one job. Returns true if begin() should be called again soon.
  /// Throws std::bad_alloc; then the comparison with the same field restarts later.
  bool compare(const std::shared_ptr<const DrawnFrame>& drawn, WorldEdits& edits, JobSystem& jobs);
  /// Reports that the job which begin() requested could not be submitted.
  void giveUp();

 private:
  using Clock = std::chrono::steady_clock;

  const bool sharp_;

  bool compareSome(const DrawnFrame& drawn, WorldEdits& edits, JobSystem& jobs);

  // Members that only compare() uses: the two fields that it compares.
  std::shared_ptr<const WorldField> from_, to_;
  std::shared_ptr<const FieldChange> change_;  ///< the comparison in progress; null if there is none
  std::vector<ChunkKey> left_;                 ///< chunks that still have to be compared

  mutable std::mutex mutex_;  ///< guards the members below
  std::shared_ptr<const WorldField> next_;
  /// The field to which the world must return, before any requested switch, because the last field could not be drawn;
  /// null if no return is necessary.
  std::shared_ptr<const WorldField> back_;
  std::shared_ptr<const WorldField> before_;  ///< the field before the unfinished change
  Turn turn_;
  uint64_t turn_begun_ = 0;  ///< number of the want() call that requested the unfinished change
  bool going_back_ = false;  ///< true if the comparison is with back_, so the world returns to an earlier field
  bool comparing_ = false;   ///< true if a comparing job is requested or running
  bool open_ = false;        ///< true from the start of a change of the field until the changed field is drawn
  /// number of the state after the unfinished change; 0 while the comparison is in progress
  uint64_t state_ = 0;
  Clock::time_point begun_, not_before_;
};

}  // namespace sgm
