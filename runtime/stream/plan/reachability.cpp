#include "stream/plan/reachability.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "stream/plan/lod_target.h"

namespace sgm {

namespace {

constexpr uint32_t kUnreached = std::numeric_limits<uint32_t>::max();

/// A flood fill from one viewer through the voids of chunks. It covers the cube of chunks around the ball in which the
/// search looks.
class VoidFlood {
 public:
  VoidFlood(const std::array<double, 3>& viewer, double radius, int32_t finest_cell, const VoidLookup& voids)
      : viewer_(viewer), radius_(radius), cell_(finest_cell), edge_(int64_t{kChunkCells} * finest_cell), voids_(voids) {
    size_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = viewer[static_cast<size_t>(axis)];
      first_[axis] = placeOf(at - radius);
      size_[axis] = std::max(0, placeOf(at + radius) - first_[axis] + 1);
      home_[axis] = placeOf(at);
      count *= static_cast<size_t>(size_[axis]);
    }
    chunks_.resize(count);
  }

  void run() {
    Chunk* home = chunkAt(home_);
    if (home == nullptr) return reachAll();
    home->steps = 0;
    if (home->voids == nullptr) return;
    const uint64_t around = voidsAround(*home->voids, homeCell());
    if (around == 0) return reachAll();
    enter(*home, home_, around, 0);
    for (size_t next = 0; next < open_.size(); ++next) spread(open_[next]);
  }

  void append(std::vector<ReachedChunk>& reached) const {
    size_t i = 0;
    for (int32_t x = 0; x < size_.x; ++x) {
      for (int32_t y = 0; y < size_.y; ++y) {
        for (int32_t z = 0; z < size_.z; ++z, ++i) {
          if (chunks_[i].steps != kUnreached) reached.push_back({keyAt({x, y, z}), chunks_[i].steps});
        }
      }
    }
  }

 private:
  struct Chunk {
    const VoidComponents* voids = nullptr;
    uint64_t entered = 0;  ///< bit i is set if the search has entered the chunk's void with number i
    uint32_t steps = kUnreached;
    bool asked = false, inside = false;
  };
  struct Void {
    Int3 at;
    int number = 0;
    uint32_t steps = 0;  ///< number of search steps from the viewer to this void; other voids of the same chunk may be
                         ///< fewer steps away
  };

  /// Returns the chunk coordinate of a position, clamped to the chunks that lie completely inside the world.
  int32_t placeOf(double units) const {
    const double first = -std::floor(2147483648.0 / static_cast<double>(edge_));
    const double last = std::floor(2147483647.0 / static_cast<double>(edge_)) - 1;
    return static_cast<int32_t>(std::clamp(std::floor(units / static_cast<double>(edge_)), first, last));
  }
  ChunkKey keyAt(Int3 at) const { return {0, {first_.x + at.x, first_.y + at.y, first_.z + at.z}}; }

  /// Returns the chunk at these coordinates; null if it is outside the ball.
  Chunk* chunkAt(Int3 place) {
    const Int3 at{place.x - first_.x, place.y - first_.y, place.z - first_.z};
    if (std::min({at.x, at.y, at.z}) < 0 || at.x >= size_.x || at.y >= size_.y || at.z >= size_.z) return nullptr;
    Chunk& chunk = chunks_[static_cast<size_t>((at.x * size_.y + at.y) * size_.z + at.z)];
    if (!chunk.asked) {
      chunk.asked = true;
      chunk.inside = distanceToChunk(viewer_, {0, place}, cell_) <= radius_;
      if (chunk.inside) chunk.voids = voids_({0, place});
    }
    return chunk.inside ? &chunk : nullptr;
  }

  Int3 homeCell() const {
    Int3 cell;
    for (int axis = 0; axis < 3; ++axis) {
      const double from = viewer_[static_cast<size_t>(axis)] - static_cast<double>(home_[axis] * edge_);
      cell[axis] = static_cast<int32_t>(std::clamp(std::floor(from / cell_), 0.0, kChunkCells - 1.0));
    }
    return cell;
  }

  void enter(Chunk& chunk, Int3 at, uint64_t numbers, uint32_t steps) {
    chunk.entered |= numbers;
    for (; numbers != 0; numbers &= numbers - 1) open_.push_back({at, std::countr_zero(numbers), steps});
  }

  void spread(const Void from) {
    const VoidComponent& component = (*chunkAt(from.at)->voids)[static_cast<size_t>(from.number)];
    for (size_t face = 0; face < 6; ++face) {
      const uint64_t mask = component.faces[face];
      if (mask == 0) continue;
      Int3 at = from.at;
      at[static_cast<int>(face) >> 1] += face & 1 ? 1 : -1;
      Chunk* there = chunkAt(at);
      if (there == nullptr) continue;
      there->steps = std::min(there->steps, from.steps + 1);
      if (there->voids == nullptr) continue;
      uint64_t met = 0;
      for (size_t i = 0; i < there->voids->size(); ++i) {
        met |= uint64_t{((*there->voids)[i].faces[face ^ 1] & mask) != 0} << i;
      }
      enter(*there, at, met & ~there->entered, from.steps + 1);
    }
  }

  void reachAll() {
    for (int32_t x = 0; x < size_.x; ++x) {
      for (int32_t y = 0; y < size_.y; ++y) {
        for (int32_t z = 0; z < size_.z; ++z) {
          const Int3 at = keyAt({x, y, z}).at;
          Chunk* chunk = chunkAt(at);
          if (chunk == nullptr) continue;
          const auto apart = [&](int axis) { return static_cast<uint32_t>(std::abs(at[axis] - home_[axis])); };
          chunk->steps = apart(0) + apart(1) + apart(2);
        }
      }
    }
  }

  const std::array<double, 3> viewer_;
  const double radius_;
  const int32_t cell_;
  const int64_t edge_;
  const VoidLookup& voids_;
  Int3 first_, size_, home_;
  std::vector<Chunk> chunks_;  ///< chunks of the cube, in the order of their keys: z varies fastest
  std::vector<Void> open_;     ///< queue of the breadth-first search
};

}  // namespace

std::vector<ReachedChunk> reachedChunks(std::span<const std::array<double, 3>> viewers, double radius,
                                        int32_t finest_cell, const VoidLookup& voids) {
  std::vector<ReachedChunk> reached;
  for (const std::array<double, 3>& viewer : viewers) {
    VoidFlood flood(viewer, radius, finest_cell, voids);
    flood.run();
    flood.append(reached);
  }
  if (viewers.size() < 2) return reached;
  std::sort(reached.begin(), reached.end());
  const auto same = [](const ReachedChunk& a, const ReachedChunk& b) { return a.key == b.key; };
  reached.erase(std::unique(reached.begin(), reached.end(), same), reached.end());
  return reached;
}

std::optional<uint32_t> stepsTo(std::span<const ReachedChunk> reached, const ChunkKey& key) {
  const auto found = std::lower_bound(reached.begin(), reached.end(), ReachedChunk{key, 0});
  if (found == reached.end() || found->key != key) return std::nullopt;
  return found->steps;
}

}  // namespace sgm
