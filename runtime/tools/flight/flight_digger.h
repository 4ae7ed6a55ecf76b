#pragma once
// Edits a streamed world near the viewer of a flight (digs), and measures how soon each edit is drawn.

#include <sgm/sgm.h>

#include <chrono>
#include <deque>
#include <optional>
#include <vector>

#include "base/hash.h"
#include "base/result.h"
#include "tools/flight/flight_curve.h"

namespace sgm::cli {

/// Median, 99th percentile and maximum of a list of values. All are 0 if there are no values.
struct Spread {
  double p50 = 0, p99 = 0, max = 0;
};
Spread spreadOf(std::vector<double> values);

struct DigReport {
  uint64_t cuts = 0, adds = 0, undos = 0;
  Spread frames;            ///< for each dig: how often the drawn frame (sgm_world_stats::frame) changed, from the dig
                            ///< to the change that made the dig visible
  Spread milliseconds;      ///< for each dig: wall time until it is visible
  uint64_t max_queued = 0;  ///< maximum number of chunks that waited for meshing after a frame, from the first dig on

  uint64_t digs() const { return cuts + adds + undos; }
};

/// Makes random edits (digs): most cut a hole of 4 m into the surface around the viewer, mostly ahead of it; some add a
/// lump behind the viewer, away from its path; some undo a recent edit. Places and kinds depend only on the seed, the
/// world and the flight. Not thread-safe.
class FlightDigger {
 public:
  /// digs_a_second: at most 60, in seconds of the path; the first second has no digs. The world must outlive the
  /// digger.
  FlightDigger(sgm_world* world, uint64_t seed, double digs_a_second);

  /// Chooses the dig for this frame, if one is due. Slow, since it casts rays. Errors: those of the world's queries.
  Result<void> plan(uint64_t frame, const FlightPlace& place);
  /// Performs the dig that plan() has chosen. Errors: those of sgm_world_edit.
  Result<void> dig();
  /// Records which of the digs that waited are drawn by now. Must be called after each frame, with the world's current
  /// statistics.
  void look(const sgm_world_stats& stats);

  /// Whether some digs have not been drawn yet.
  bool waits() const { return !waiting_.empty(); }
  DigReport report() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Dig {
    bool undo = false;
    sgm_brush brush = SGM_BRUSH_INIT;
    size_t undone = 0;  ///< if `undo` is set: index into last_ of the edit to undo
  };
  struct Waiting {
    /// state: number of the first edit state that includes the dig. commits: value of commits_ when the dig was made.
    uint64_t state, commits;
    Clock::time_point since;
  };

  Result<sgm_surface_point> surfaceNear(const FlightPlace& place, const PathKey& key, bool ahead);

  sgm_world* world_;
  PathKey key_;
  double a_frame_;
  std::optional<Dig> planned_;
  std::optional<Clock::time_point> dug_;  ///< time of the dig in the current frame; nullopt if this frame has no dig
  std::deque<sgm_edit_id> last_;          ///< recent edits that can be undone. An undo is an edit too: undoing it
                                          ///< restores the undone edit
  std::deque<Waiting> waiting_;
  uint64_t frame_ = 0;  ///< the world's frame number at the last call of look()
  /// Number of commits (changes of the drawn frame) so far. Counted here because the world's frame number may rise by
  /// more than one at a time.
  uint64_t commits_ = 0;
  DigReport report_;
  std::vector<double> frames_, milliseconds_;
};

}  // namespace sgm::cli
