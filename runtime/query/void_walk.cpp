#include "query/void_walk.h"

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
constexpr uint64_t kNotReached = std::numeric_limits<uint64_t>::max();
// The entry of Steps for a sample at which a walk enters the chunk, and for samples that no walk reaches. For other
// samples, the entry is the number of a step, 0..26.
constexpr uint8_t kStart = 27;
constexpr size_t kChunksAtOnce = 64;  // number of chunks in a group that is processed together
// costs of a step along an axis, and of a step across a face's diagonal: their ratio is the square root of 2, to 5 in
// 100,000
constexpr uint64_t kAlongAxis = 70, kAcrossFace = 99;

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

/// A sample where a walk enters a chunk, and the walk's cost up to there.
struct Entry {
  uint64_t cost = 0;
  uint32_t at = 0;  ///< index of the sample among the chunk's samples

  friend auto operator<=>(const Entry&, const Entry&) = default;
};

using Entries = std::pmr::vector<Entry>;
/// for each sample of a chunk: the last step of the shortest walk to it; kStart where a walk enters the chunk
using Steps = std::pmr::vector<uint8_t>;

/// Finds the shortest walks in one chunk from its entries to all samples (Dijkstra).
class ChunkWalks {
 public:
  ChunkWalks(std::span<const uint64_t> closed, std::span<const Entry> entries, std::pmr::memory_resource* memory)
      : steps(kSamples, kStart, memory), cost_(kSamples, kNotReached, memory) {
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const Entry& entry : entries) {
      cost_[entry.at] = entry.cost;
      queue.push(entry);
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
        const uint64_t cost = so_far + (axes == 1 ? kAlongAxis : kAcrossFace);
        if (cost >= cost_[to]) continue;
        cost_[to] = cost;
        steps[to] = static_cast<uint8_t>(number);
        queue.push({cost, static_cast<uint32_t>(to)});
      }
    }
  }

  /// Returns the entries into the adjacent chunk on this side: those samples of the common face that a walk reaches,
  /// with their indices in the adjacent chunk.
  Entries entriesTo(Int3 side) const {
    Entries found(cost_.get_allocator());
    for (size_t i = 0; i < kSamples; ++i) {
      if (cost_[i] == kNotReached) continue;
      const Int3 local = localOf(i);
      bool shared = true;
      for (int axis = 0; axis < 3; ++axis)
        shared = shared && (side[axis] == 0 || local[axis] == (side[axis] > 0 ? kChunkCells : 0));
      if (shared) found.push_back({cost_[i], static_cast<uint32_t>(indexOf(minus(local, firstSampleOf(side))))});
    }
    return found;
  }

  Steps steps;

 private:
  std::pmr::vector<uint64_t> cost_;
};

/// Finds a shortest walk through a sequence of chunks, which are processed in groups. A first pass, forwards, finds the
/// entries into each group. A second pass, backwards, traces the walk.
class Walk {
 public:
  Walk(SignWindow& window, JobSystem& jobs, std::span<const Int3> chunks, int need, std::pmr::memory_resource* memory,
       const Progress& progress)
      : window_(window), jobs_(jobs), chunks_(chunks), need_(need), memory_(memory), progress_(progress) {}

  Result<std::vector<Int3>> between(Int3 from, Int3 to) {
    const size_t last = (chunks_.size() - 1) / kChunksAtOnce;
    // The second pass skips the computation for the last group: the steps of this group are still in memory from the
    // first pass.
    total_ = chunks_.size() + last * kChunksAtOnce;
    std::vector<Entries> entries;
    entries.emplace_back(memory_).push_back({0, static_cast<uint32_t>(indexIn(0, from))});
    std::vector<Steps> steps;
    for (size_t group = 0; group <= last; ++group) {
      Entries reached = entries[group];
      if (const Result<void> ok = look(group, reached, steps); !ok) return ok.error();
      if (group < last) entries.push_back(std::move(reached));
    }
    std::vector<Int3> walk{to};
    for (size_t group = last + 1; group-- > 0;) {
      if (group < last) {
        if (const Result<void> ok = look(group, entries[group], steps); !ok) return ok.error();
      }
      for (size_t i = steps.size(); i-- > 0;) {
        for (;;) {
          const uint8_t number = steps[i][indexIn(group * kChunksAtOnce + i, walk.back())];
          if (number == kStart) break;
          walk.push_back(minus(walk.back(), stepOf(number)));
        }
      }
    }
    std::reverse(walk.begin(), walk.end());
    return walk;
  }

 private:
  size_t indexIn(size_t chunk, Int3 sample) const { return indexOf(minus(sample, firstSampleOf(chunks_[chunk]))); }

  /// Computes the steps in the chunks of a group. entries: on entry, the entries into the group's first chunk; on
  /// return, the entries into the chunk after the group.
  Result<void> look(size_t group, Entries& entries, std::vector<Steps>& steps) {
    const size_t first = group * kChunksAtOnce;
    const std::span<const Int3> some = chunks_.subspan(first, std::min(kChunksAtOnce, chunks_.size() - first));
    std::vector<Int3> seen;
    for (const Int3 chunk : some) {
      const std::vector<Int3> around = chunksAround(chunk, need_ > 1 ? 1 : 0);
      seen.insert(seen.end(), around.begin(), around.end());
    }
    std::sort(seen.begin(), seen.end());
    window_.dropUnless([&](Int3 chunk) { return std::binary_search(seen.begin(), seen.end(), chunk); });
    if (const Result<void> added = window_.add(seen, jobs_); !added) return added.error();
    std::vector<std::optional<std::pmr::vector<uint64_t>>> closed(some.size());
    parallelFor(jobs_, some.size(), [&](size_t i) { closed[i] = rowsBelow(window_.clearance(some[i], need_), need_); });
    steps.clear();
    for (size_t i = 0; i < some.size(); ++i) {
      ChunkWalks walks(*closed[i], entries, memory_);
      if (first + i + 1 < chunks_.size()) entries = walks.entriesTo(minus(chunks_[first + i + 1], some[i]));
      steps.push_back(std::move(walks.steps));
      if (progress_ && !progress_(++done_, total_) && done_ < total_)
        return Error{Code::cancelled, "the search for a path was cancelled"};
    }
    return {};
  }

  SignWindow& window_;
  JobSystem& jobs_;
  std::span<const Int3> chunks_;
  int need_;
  std::pmr::memory_resource* memory_;
  const Progress& progress_;
  uint64_t done_ = 0, total_ = 0;
};

}  // namespace

Result<std::vector<Int3>> shortestWalk(SignWindow& window, JobSystem& jobs, std::span<const Int3> chunks, Int3 from,
                                       Int3 to, int need, std::pmr::memory_resource* memory, const Progress& progress) {
  return Walk(window, jobs, chunks, need, memory, progress).between(from, to);
}

double lengthOf(std::span<const Int3> walk) {
  size_t straight = 0, across = 0;
  for (size_t i = 1; i < walk.size(); ++i) ++(axesOf(minus(walk[i], walk[i - 1])) == 1 ? straight : across);
  return static_cast<double>(straight) + std::sqrt(2.0) * static_cast<double>(across);
}

}  // namespace sgm
