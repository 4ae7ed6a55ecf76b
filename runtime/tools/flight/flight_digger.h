#pragma once
// Digs in a streamed world around a flight, and watches how soon each dig is drawn.

#include <sgm/sgm.h>

#include <chrono>
#include <deque>
#include <optional>
#include <vector>

#include "base/hash.h"
#include "base/result.h"
#include "tools/flight/flight_curve.h"

namespace sgm::cli {

/// Of a number of values: the one in the middle, the one that one in a hundred exceeds, the largest. All 0 for none.
struct Spread {
  double p50 = 0, p99 = 0, max = 0;
};
Spread spreadOf(std::vector<double> values);

struct DigReport {
  uint64_t cuts = 0, adds = 0, undos = 0;
  Spread frames;             ///< frames of changes from a dig until it is drawn
  Spread milliseconds;       ///< likewise, on the wall
  uint64_t most_queued = 0;  ///< chunks that waited to be meshed after any frame from the first dig on

  uint64_t digs() const { return cuts + adds + undos; }
};

/// Most digs cut a hole of 4 m into the surface around the viewer, most of these ahead of it; some add a lump behind
/// it, where it does not come soon; some undo one of the last. Where and what is a function of the seed, the world and
/// the flight alone. One thread at a time.
class FlightDigger {
 public:
  /// At most 60 digs a second of the path, the first after a second. The world must outlive the digger.
  FlightDigger(sgm_world* world, uint64_t seed, double digs_a_second);

  /// Finds what to dig in this frame, if anything. Takes its time. Errors: those of the world's queries.
  Result<void> plan(uint64_t frame, const FlightPlace& place);
  /// Digs that, as an engine does. Errors: those of sgm_world_edit.
  Result<void> dig();
  /// After a frame, with what the world says then.
  void look(const sgm_world_stats& stats);

  /// Whether digs wait to be drawn.
  bool waits() const { return !waiting_.empty(); }
  DigReport report() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Dig {
    bool undo = false;
    sgm_brush brush = SGM_BRUSH_INIT;
    size_t undone = 0;  ///< of last_
  };
  struct Waiting {
    uint64_t state, commits;  ///< of the edits with the dig; before it
    Clock::time_point since;
  };

  Result<sgm_surface_point> surfaceNear(const FlightPlace& place, const PathKey& key, bool ahead);

  sgm_world* world_;
  PathKey key_;
  double a_frame_;
  std::optional<Dig> planned_;
  std::optional<Clock::time_point> dug_;  ///< in this frame
  std::deque<sgm_edit_id> last_;          ///< that can be undone; an undo among them is redone
  std::deque<Waiting> waiting_;
  uint64_t frame_ = 0;    ///< that was drawn after the last look
  uint64_t commits_ = 0;  ///< changes of what is drawn: a frame's number may rise by more than one
  DigReport report_;
  std::vector<double> frames_, milliseconds_;
};

}  // namespace sgm::cli
