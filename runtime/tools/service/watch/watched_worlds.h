#pragma once
// Samples streamed worlds in its own thread, through the C interface: never runs in the engine's threads.

#include <sgm/sgm.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::service {

/// The state of a world at its last sampling.
struct WorldSample {
  std::string name;
  sgm_world_info info = SGM_WORLD_INFO_INIT;     ///< constant data: backend, cell, limits
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;  ///< chunks_in_vain as its maximum so far, so that it never falls
  sgm_world_times times = SGM_WORLD_TIMES_INIT;  ///< histograms
  std::optional<sgm_world_measures> measures;    ///< of worlds with SGM_WORLD_MEASURE
  std::vector<sgm_viewer> viewers;
  double chunks_per_second = 0;  ///< meshed or read, over the last seconds
  /// Mean number of concurrent meshing jobs over the last seconds with any, at most the world's threads. nullopt before
  /// the first.
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
  std::vector<DrawnChunk> chunks;  ///< at most kMostMapped, the finest first, then the nearest to a viewer
};
inline constexpr size_t kMostMapped = 20000;
inline constexpr size_t kMostWorlds = 16;

/// Thread-safe.
class WatchedWorlds {
 public:
  /// Samples every world once in `period`. Error: io if no thread can be started.
  static Result<std::unique_ptr<WatchedWorlds>> create(std::chrono::milliseconds period = std::chrono::seconds(1));
  virtual ~WatchedWorlds() = default;

  /// Watches a world, which must live until forget() has returned, and samples it once before returning. name: letters,
  /// digits, '_', '-' and '.', at most 64, unique among watched worlds. Errors: invalid_argument; limit for more than
  /// kMostWorlds; busy for a world or name that is already watched; those of querying the world.
  virtual Result<void> watch(const std::string& name, sgm_world* world) = 0;
  /// Blocks until the world is no longer in use. Does nothing for a world that is not watched.
  virtual void forget(sgm_world* world) = 0;

  /// The last samples, by name. Never blocks on a world.
  virtual std::vector<WorldSample> samples() const = 0;
  /// The drawn chunks, at most a second old: gathered only on request. The first caller waits for it, a fraction of a
  /// millisecond for a thousand chunks. nullopt if there is no such world, or it cannot be queried now.
  virtual std::optional<WorldMap> map(const std::string& name) = 0;
};

}  // namespace sgm::service
