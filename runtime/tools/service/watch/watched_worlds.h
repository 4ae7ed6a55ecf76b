#pragma once
// Samples streamed worlds in a thread of its own, through the C interface, so that the engine's threads do no work for
// it.

#include <sgm/sgm.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::service {

/// The state of a world when it was last sampled.
struct WorldSample {
  std::string name;
  sgm_world_info info = SGM_WORLD_INFO_INIT;  ///< constant properties: backend, cell size, limits
  /// chunks_in_vain is the maximum of all samples so far, so that it never decreases
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  sgm_world_times times = SGM_WORLD_TIMES_INIT;  ///< histograms of times
  std::optional<sgm_world_measures> measures;    ///< measures of chunks; set for worlds with SGM_WORLD_MEASURE
  std::vector<sgm_viewer> viewers;
  double chunks_per_second = 0;  ///< rate of chunks that were meshed or read, over the last seconds
  /// Mean number of concurrent meshing jobs during those of the last seconds in which there were any, at most the
  /// number of the world's threads. nullopt before the first job.
  std::optional<double> parallel_speedup;
  std::chrono::steady_clock::time_point taken;
};

struct DrawnChunk {
  int32_t level = 0, x = 0, y = 0, z = 0;
  uint32_t triangles = 0;
};
struct WorldMap {
  WorldSample world;
  uint64_t total = 0;
  /// At most kMaxMapped chunks; the finest first, and among equals those nearest to a viewer.
  std::vector<DrawnChunk> chunks;
};
inline constexpr size_t kMaxMapped = 20000;
inline constexpr size_t kMaxWorlds = 16;

/// The set of sampled worlds. Thread-safe.
class WatchedWorlds {
 public:
  /// Samples every world once in each `period`. Error: io if no thread can be started.
  static Result<std::unique_ptr<WatchedWorlds>> create(std::chrono::milliseconds period = std::chrono::seconds(1));
  virtual ~WatchedWorlds() = default;

  /// Adds a world, and samples it once before returning. The world must live until forget() has returned. name:
  /// letters, digits, '_', '-' and '.', at most 64 characters, unique among watched worlds. Errors: invalid_argument;
  /// limit for more than kMaxWorlds worlds; busy if the world or the name is already in use; those of querying the
  /// world.
  virtual Result<void> watch(const std::string& name, sgm_world* world) = 0;
  /// Removes a world. Blocks until this object no longer uses it. Does nothing if the world is not watched.
  virtual void forget(sgm_world* world) = 0;

  /// The latest samples, ordered by name. Never blocks on a world.
  virtual std::vector<WorldSample> samples() const = 0;
  /// The drawn chunks of a world, at most a second old. They are gathered only on request: the first caller waits, for
  /// a fraction of a millisecond with a thousand chunks. nullopt if there is no such world, or it cannot be queried
  /// now.
  virtual std::optional<WorldMap> map(const std::string& name) = 0;
};

}  // namespace sgm::service
