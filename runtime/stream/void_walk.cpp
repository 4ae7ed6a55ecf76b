#include "stream/void_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace sgm {

namespace {

constexpr int kSide = kChunkSamples;
constexpr size_t kSamples = size_t{kSide} * kSide * kSide;
constexpr uint32_t kUnreached = std::numeric_limits<uint32_t>::max();
constexpr uint8_t kStart = 27;                         // no step leads here: it is where a walk enters the chunk
constexpr size_t kChunksAtOnce = 64;                   // chunks that are looked at together
constexpr uint32_t kAlongAxis = 70, kAcrossFace = 99;  // their ratio is the root of 2, to 5 in 100,000

Int3 stepOf(int number) { return {number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1}; }
int axesOf(Int3 step) { return std::abs(step.x) + std::abs(step.y) + std::abs(step.z); }

size_t indexOf(Int3 local) { return static_cast<size_t>(local.x + kSide * (local.y + kSide * local.z)); }
Int3 localOf(size_t index) {
  const auto i = static_cast<int32_t>(index);
  return {i % kSide, i / kSide % kSide, i / kSide / kSide};
}
Int3 minus(Int3 a, Int3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Int3 plus(Int3 a, Int3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Int3 firstSampleOf(Int3 chunk) { return {chunk.x * kChunkCells, chunk.y * kChunkCells, chunk.z * kChunkCells}; }

/// Where a walk is in a chunk, and how long it has been.
struct Reached {
  uint32_t cost = 0;
  Int3 sample;  ///< of the lattice
};

/// The shortest walks in one chunk, from where it is entered (Dijkstra).
class ChunkWalks {
 public:
  ChunkWalks(std::span<const uint64_t> closed, Int3 chunk, std::span<const Reached> entries,
             std::pmr::memory_resource* memory)
      : steps(kSamples, kStart, memory), first_(firstSampleOf(chunk)), cost_(kSamples, kUnreached, memory) {
    using Entry = std::pair<uint32_t, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const Reached& entry : entries) {
      const size_t at = indexOf(minus(entry.sample, first_));
      cost_[at] = entry.cost;
      queue.push({entry.cost, static_cast<uint32_t>(at)});
    }
    while (!queue.empty()) {
      const auto [so_far, at] = queue.top();
      queue.pop();
      if (so_far > cost_[at]) continue;
      const Int3 here = localOf(at);
      for (int number = 0; number < 27; ++number) {
        const Int3 step = stepOf(number), there = plus(here, step);
        const int axes = axesOf(step);
        if (axes == 0 || axes == 3 || std::min({there.x, there.y, there.z}) < 0 ||
            std::max({there.x, there.y, there.z}) >= kSide)
          continue;
        if ((closed[static_cast<size_t>(there.y + kSide * there.z)] >> there.x & 1) != 0) continue;
        const size_t to = indexOf(there);
        const uint32_t cost = so_far + (axes == 1 ? kAlongAxis : kAcrossFace);
        if (cost >= cost_[to]) continue;
        cost_[to] = cost;
        steps[to] = static_cast<uint8_t>(number);
        queue.push({cost, static_cast<uint32_t>(to)});
      }
    }
  }

  /// What was reached of the face that the chunk shares with another one.
  std::vector<Reached> reachedTowards(Int3 side) const {
    std::vector<Reached> found;
    for (size_t i = 0; i < kSamples; ++i) {
      if (cost_[i] == kUnreached) continue;
      const Int3 local = localOf(i);
      bool shared = true;
      for (int axis = 0; axis < 3; ++axis)
        shared = shared && (side[axis] == 0 || local[axis] == (side[axis] > 0 ? kChunkCells : 0));
      if (shared) found.push_back({cost_[i], plus(local, first_)});
    }
    return found;
  }

  std::pmr::vector<uint8_t> steps;  ///< the last step to each sample; kStart where a walk enters

 private:
  Int3 first_;
  std::pmr::vector<uint32_t> cost_;
};

}  // namespace

Result<std::vector<Int3>> shortestWalk(SignWindow& window, JobSystem& jobs, std::span<const Int3> chunks, Int3 from,
                                       Int3 to, int need, std::pmr::memory_resource* memory) {
  std::vector<std::pmr::vector<uint8_t>> steps;
  std::vector<Reached> entries{{0, from}};
  for (size_t first = 0; first < chunks.size(); first += kChunksAtOnce) {
    const std::span<const Int3> some = chunks.subspan(first, std::min(kChunksAtOnce, chunks.size() - first));
    std::vector<Int3> seen;
    for (const Int3 chunk : some) {
      const std::vector<Int3> around = chunksAround(chunk, need > 1 ? 1 : 0);
      seen.insert(seen.end(), around.begin(), around.end());
    }
    std::sort(seen.begin(), seen.end());
    window.dropUnless([&](Int3 chunk) { return std::binary_search(seen.begin(), seen.end(), chunk); });
    if (const Result<void> added = window.add(seen, jobs); !added) return added.error();
    std::vector<std::optional<std::pmr::vector<uint64_t>>> closed(some.size());
    parallelFor(jobs, some.size(), [&](size_t i) { closed[i] = rowsBelow(window.clearance(some[i], need), need); });
    for (size_t i = 0; i < some.size(); ++i) {
      ChunkWalks walks(*closed[i], some[i], entries, memory);
      if (first + i + 1 < chunks.size()) entries = walks.reachedTowards(minus(chunks[first + i + 1], some[i]));
      steps.push_back(std::move(walks.steps));
    }
  }
  std::vector<Int3> walk{to};
  for (size_t i = chunks.size(); i-- > 0;) {
    for (;;) {
      const uint8_t number = steps[i][indexOf(minus(walk.back(), firstSampleOf(chunks[i])))];
      if (number == kStart) break;
      walk.push_back(minus(walk.back(), stepOf(number)));
    }
  }
  std::reverse(walk.begin(), walk.end());
  return walk;
}

double lengthOf(std::span<const Int3> walk) {
  size_t straight = 0, across = 0;
  for (size_t i = 1; i < walk.size(); ++i) ++(axesOf(minus(walk[i], walk[i - 1])) == 1 ? straight : across);
  return static_cast<double>(straight) + std::sqrt(2.0) * static_cast<double>(across);
}

}  // namespace sgm
