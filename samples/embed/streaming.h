#pragma once
// The calls that an engine makes for a streamed world in each frame.

#include <sgm/sgm.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <vector>

#include "handles.h"
#include "scene.h"

using Place = std::array<double, 3>;  ///< a position in metres

/// The results of a flight through the world.
struct Flight {
  int frames = 0;
  DrawCounts drawn;  ///< counts of the last drawn frame
  size_t uploaded = 0;
  std::chrono::steady_clock::duration longest_update{};
};

class Streaming {
 public:
  using Clock = std::chrono::steady_clock;

  /// The world must outlive this object.
  explicit Streaming(sgm_world* world) : world_(world) {}

  void frame(const Place& at, const Place& velocity) {
    sgm_error error = SGM_ERROR_INIT;
    sgm_viewer viewer = SGM_VIEWER_INIT;
    std::array<int32_t, 3> camera{};
    for (size_t axis = 0; axis < 3; ++axis) {
      viewer.position[axis] = at[axis];
      viewer.direction[axis] = viewer.velocity[axis] = static_cast<float>(velocity[axis]);
      camera[axis] = static_cast<int32_t>(std::floor(at[axis] * SGM_UNITS_PER_METRE));
    }
    must(sgm_world_set_viewers(world_, &viewer, 0, 1, &error), error);
    const Clock::time_point before = Clock::now();
    must(sgm_world_update(world_, kBytesPerFrame, &error), error);
    flight_.longest_update = std::max(flight_.longest_update, Clock::now() - before);
    sgm_world_event events[64];
    for (size_t count = std::size(events); count > 0;) {
      count = std::size(events);
      must(sgm_world_poll(world_, events, 0, &count, &error), error);
      for (size_t i = 0; i < count; ++i) scene_.take(events[i]);
    }
    // All changes of the frame have been processed, so the drawn surface has no gaps.
    flight_.drawn = scene_.draw(camera);
    flight_.uploaded = scene_.uploadedBytes();
    ++flight_.frames;
  }

  bool idle() const {
    sgm_world_stats stats = SGM_WORLD_STATS_INIT;
    sgm_error error = SGM_ERROR_INIT;
    must(sgm_world_get_stats(world_, &stats, &error), error);
    return stats.idle != 0;
  }

  /// Whether the chunks that the events have made visible equal those that the world reports as drawn.
  bool agrees() const {
    sgm_error error = SGM_ERROR_INIT;
    size_t count = 0;
    must(sgm_world_get_drawn(world_, nullptr, 0, &count, &error), error);
    std::vector<sgm_drawn_chunk> chunks(count);
    must(sgm_world_get_drawn(world_, chunks.data(), 0, &count, &error), error);
    std::vector<MeshOwner> owners;
    for (const sgm_drawn_chunk& chunk : chunks) owners.emplace_back(chunk.mesh);
    return scene_.draws(chunks);
  }

  const Flight& flight() const { return flight_; }

 private:
  static constexpr uint64_t kBytesPerFrame = 1 << 20;

  sgm_world* world_;
  Scene scene_;
  Flight flight_;
};
