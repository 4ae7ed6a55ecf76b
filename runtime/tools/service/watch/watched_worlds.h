#pragma once
// Looks at streamed worlds from a thread of its own, through the C interface: nothing of it runs on the engine's.

#include <sgm/sgm.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::service {

/// A world as it was when it was last looked at.
struct WorldSample {
  std::string name;
  sgm_world_info info = SGM_WORLD_INFO_INIT;     ///< what does not change: backend, cell, limits
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;  ///< chunks_in_vain as the most that it was: what rises, never falls
  sgm_world_times times = SGM_WORLD_TIMES_INIT;  ///< histograms
  std::optional<sgm_world_measures> measures;    ///< of worlds with SGM_WORLD_MEASURE
  std::vector<sgm_viewer> viewers;
  double chunks_per_second = 0;  ///< meshed or read, over the last few seconds
  /// Jobs that meshed at one time on average, over the last seconds in which any did; at most the world's threads.
  /// Nothing before the first.
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

/// Any thread.
class WatchedWorlds {
 public:
  /// Looks at every world once in `period`. Error: io where no thread can be started.
  static Result<std::unique_ptr<WatchedWorlds>> create(std::chrono::milliseconds period = std::chrono::seconds(1));
  virtual ~WatchedWorlds() = default;

  /// From now on; the world must live until forget() has returned. name: of letters, digits, '_', '-' and '.', at most
  /// 64, one that no other watched world has. Errors: invalid_argument; limit past kMostWorlds; busy for a world or a
  /// name that is watched; what asking the world fails with. It is looked at once before this returns.
  virtual Result<void> watch(const std::string& name, sgm_world* world) = 0;
  /// Waits until nothing looks at it. Does nothing for a world that is not watched.
  virtual void forget(sgm_world* world) = 0;

  /// The last samples, by name. Never waits for a world.
  virtual std::vector<WorldSample> samples() const = 0;
  /// What is drawn, as of the last second: gathered only while somebody asks. The first to ask waits for it, a
  /// fraction of a millisecond a thousand chunks. Nothing: no such world, or it cannot be asked now.
  virtual std::optional<WorldMap> map(const std::string& name) = 0;
};

}  // namespace sgm::service
