#pragma once
// Digs in a streamed world around a flight, and measures how soon each dig is drawn.

#include <sgm/sgm.h>

#include <chrono>
#include <deque>
#include <optional>
#include <vector>

#include "base/hash.h"
#include "base/result.h"
#include "tools/flight/flight_curve.h"

namespace sgm::cli {

/// Median, 99th percentile and maximum of some values. All are 0 if there are no values.
struct Spread {
  double p50 = 0, p99 = 0, max = 0;
};
Spread spreadOf(std::vector<double> values);

struct DigReport {
  uint64_t cuts = 0, adds = 0, undos = 0;
  Spread frames;            ///< number of changed pictures (commits) from a dig until the picture that shows it
  Spread milliseconds;      ///< wall time from a dig until it is drawn
  uint64_t max_queued = 0;  ///< maximum number of chunks that waited for meshing after a frame, since the first dig

  uint64_t digs() const { return cuts + adds + undos; }
};

/// Most digs cut a hole of 4 m into the surface around the viewer, mostly ahead of it; some add a lump behind it, off
/// its path; some undo one of the last digs. Places and kinds depend only on the seed, the world and the flight. Not
/// thread-safe.
class FlightDigger {
 public:
  /// Digs at most 60 times per second of the path, for the first time after one second. The world must outlive the
  /// digger.
  FlightDigger(sgm_world* world, uint64_t seed, double digs_a_second);

  /// Chooses the dig of this frame, if a dig is due. Slow. Errors: those of the world's queries.
  Result<void> plan(uint64_t frame, const FlightPlace& place);
  /// Performs the chosen dig, as an engine would. Errors: those of sgm_world_edit.
  Result<void> dig();
  /// Must be called after each frame, with the world's current statistics.
  void look(const sgm_world_stats& stats);

  /// Whether some digs are not drawn yet.
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
    /// Number of the edit state that includes the dig; number of commits when the dig was made.
    uint64_t state, commits;
    Clock::time_point since;
  };

  Result<sgm_surface_point> surfaceNear(const FlightPlace& place, const PathKey& key, bool ahead);

  sgm_world* world_;
  PathKey key_;
  double a_frame_;
  std::optional<Dig> planned_;
  std::optional<Clock::time_point> dug_;  ///< time of the dig in this frame; nullopt if there was none
  std::deque<sgm_edit_id> last_;          ///< recent edits that can be undone; undoing an undo repeats the edit
  std::deque<Waiting> waiting_;
  uint64_t frame_ = 0;  ///< number of the frame that was drawn at the last call of look()
  /// Number of changes of the picture so far; counted because the drawn frame's number may rise by more than one at a
  /// time.
  uint64_t commits_ = 0;
  DigReport report_;
  std::vector<double> frames_, milliseconds_;
};

}  // namespace sgm::cli
