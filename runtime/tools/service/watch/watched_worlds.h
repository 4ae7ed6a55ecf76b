#pragma once
// Samples streamed worlds through the C interface. Uses a thread of its own, so that the engine's threads do no work
// for it.

#include <sgm/sgm.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::service {

/// The state of a world at the time of one sample.
struct WorldSample {
  std::string name;
  sgm_world_info info = SGM_WORLD_INFO_INIT;  ///< constant properties of the world: backend, cell size, limits
  /// counters of the world; chunks_in_vain is the maximum of its values in all samples so far, so that it never
  /// decreases
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  sgm_world_times times = SGM_WORLD_TIMES_INIT;  ///< histograms of durations
  std::optional<sgm_world_measures> measures;    ///< measures of the chunks' meshes; only for worlds created with
                                                 ///< SGM_WORLD_MEASURE
  std::vector<sgm_viewer> viewers;
  double chunks_per_second = 0;  ///< number of chunks per second that were meshed or read; mean over the last seconds
  /// Mean number of meshing jobs that ran concurrently. The mean covers the time in the last seconds during which at
  /// least one job ran. It is at most the number of the world's threads; nullopt before the first job.
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
  /// At most kMaxMapped chunks: the finest first, and at equal levels those nearest to a viewer first.
  std::vector<DrawnChunk> chunks;
};
inline constexpr size_t kMaxMapped = 20000;
inline constexpr size_t kMaxWorlds = 16;

/// The set of worlds that the service samples. Thread-safe.
class WatchedWorlds {
 public:
  /// Starts the thread, which samples every world once in each period. Error: io if the thread cannot be started.
  static Result<std::unique_ptr<WatchedWorlds>> create(std::chrono::milliseconds period = std::chrono::seconds(1));
  virtual ~WatchedWorlds() = default;

  /// Adds a world and samples it once before returning. Contract: the world lives until forget() has returned. name:
  /// unique, at most 64 letters, digits, '_', '-' and '.'. Errors: invalid_argument; limit if there are kMaxWorlds
  /// worlds already; busy if the world or the name is already in use; the errors of querying the world.
  virtual Result<void> watch(const std::string& name, sgm_world* world) = 0;
  /// Removes a world. Blocks until no thread uses it any more. No effect if the world is not in the set.
  virtual void forget(sgm_world* world) = 0;

  /// The latest sample of each world, ordered by name. Does not block while a world is being sampled.
  virtual std::vector<WorldSample> samples() const = 0;
  /// The drawn chunks of a world, at most a second old. They are queried only on request, which blocks the caller: a
  /// fraction of a millisecond for a thousand chunks. nullopt if there is no such world, or if it cannot be queried at
  /// present.
  virtual std::optional<WorldMap> map(const std::string& name) = 0;
};

}  // namespace sgm::service
