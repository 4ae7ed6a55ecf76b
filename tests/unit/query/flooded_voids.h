#pragma once
// Samples of a box, and reference results that are computed from all samples at once.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <queue>
#include <vector>

#include "backend/cpu/instruction_sets.h"
#include "field/prune.h"
#include "query/void_path.h"
#include "world/world_support.h"

namespace sgm {

/// Signs of samples; x varies fastest. Everything outside the box is solid.
class SampledBox {
 public:
  SampledBox(Int3 low, Int3 size) : low_(low), size_(size) {
    solid_.assign(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z), 1);
  }

  /// Samples a world block by block, each with a field program that is pruned to the block.
  SampledBox(const WorldField& world, Int3 low, Int3 size) : SampledBox(low, size) {
    const int32_t cell = world.settings().finest_cell;
    const auto units = [&](Int3 p) { return Int3{p.x * cell, p.y * cell, p.z * cell}; };
    const auto program = world.compile({units(low), units(sampleAt(solid_.size() - 1))}, 0);
    REQUIRE(program);
    EvalScratch scratch;
    PruneScratch pruning;
    PrunedProgram pruned;
    constexpr int kBlock = 8;
    for (int z = 0; z < size.z; z += kBlock)
      for (int y = 0; y < size.y; y += kBlock)
        for (int x = 0; x < size.x; x += kBlock) {
          const Int3 first{low.x + x, low.y + y, low.z + z};
          std::vector<Int3> samples;
          std::array<std::vector<int32_t>, 3> at;
          for (int i = 0; i < kBlock * kBlock * kBlock; ++i) {
            const Int3 p{first.x + i % kBlock, first.y + i / kBlock % kBlock, first.z + i / kBlock / kBlock};
            if (!has(p)) continue;
            samples.push_back(p);
            for (int axis = 0; axis < 3; ++axis) at[static_cast<size_t>(axis)].push_back(p[axis] * cell);
          }
          prune((*program)->view(), {units(first), units(samples.back())}, pruning, pruned);
          std::vector<int32_t> q(samples.size(), pruned.solid() ? -1 : 1);
          if (!pruned.solid() && !pruned.empty())
            bestKernels().samples(pruned.view(), {at[0].data(), at[1].data(), at[2].data(), q.size()}, scratch,
                                  q.data());
          for (size_t i = 0; i < q.size(); ++i) set(samples[i], q[i] < 0);
        }
  }

  size_t samples() const { return solid_.size(); }
  bool has(Int3 p) const {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < low_[axis] || p[axis] >= low_[axis] + size_[axis]) return false;
    return true;
  }
  size_t index(Int3 p) const {
    return static_cast<size_t>(p.x - low_.x + size_.x * (p.y - low_.y + size_.y * (p.z - low_.z)));
  }
  Int3 sampleAt(size_t index) const {
    const auto i = static_cast<int32_t>(index);
    return {low_.x + i % size_.x, low_.y + i / size_.x % size_.y, low_.z + i / size_.x / size_.y};
  }
  bool solid(Int3 p) const { return !has(p) || solid_[index(p)] != 0; }
  void set(Int3 p, bool solid) {
    if (has(p)) solid_[index(p)] = solid;
  }

  /// The samples as chunks of signs; a chunk whose samples all have the same sign is stored as uniform.
  SignField field(int32_t cell) const {
    return {[this](Int3 chunk) -> Result<ChunkSigns> {
              ChunkSigns signs;
              size_t count = 0;
              for (int z = 0; z < kChunkSamples; ++z) {
                for (int y = 0; y < kChunkSamples; ++y) {
                  uint64_t& row = signs.rows.emplace_back(0);
                  for (int x = 0; x < kChunkSamples; ++x)
                    row |= uint64_t{solid({chunk.x * 32 + x, chunk.y * 32 + y, chunk.z * 32 + z})} << x;
                  count += static_cast<size_t>(std::popcount(row));
                }
              }
              signs.solid = count > 0;
              if (count == 0 || count == 33 * 33 * 33) signs.rows.clear();
              return signs;
            },
            cell, std::pmr::get_default_resource()};
  }

 private:
  Int3 low_, size_;
  std::vector<uint8_t> solid_;
};

/// The steps from a sample to the neighbours with which it is connected.
inline const std::vector<Int3>& joiningSteps() {
  static const std::vector<Int3> steps = [] {
    std::vector<Int3> all;
    for (int n = 0; n < 27; ++n) {
      const Int3 step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      const int axes = step.x * step.x + step.y * step.y + step.z * step.z;
      if (axes == 1 || axes == 2) all.push_back(step);
    }
    return all;
  }();
  return steps;
}

/// Finds all voids of a closed box of samples in which a ball fits. Examines the surroundings of every sample, and then
/// finds the connected samples by a flood fill.
class FloodedVoids {
 public:
  FloodedVoids(const SampledBox& lattice, const IntBox& region, double radius_in_cells)
      : lattice_(lattice), number_(lattice.samples(), kClosed) {
    const int reach = static_cast<int>(radius_in_cells);
    std::vector<std::pair<int, Int3>> ball;
    for (int z = -reach; z <= reach; ++z)
      for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
          const int square = x * x + y * y + z * z;
          if (square <= radius_in_cells * radius_in_cells) ball.push_back({square, {x, y, z}});
        }
    std::sort(ball.begin(), ball.end());
    for (size_t i = 0; i < number_.size(); ++i) {
      const Int3 p = lattice.sampleAt(i);
      const bool open = region.contains(p) && std::none_of(ball.begin(), ball.end(), [&](const auto& near) {
                          return lattice.solid({p.x + near.second.x, p.y + near.second.y, p.z + near.second.z});
                        });
      if (open) number_[i] = kOpen;
    }
    for (size_t i = 0; i < number_.size(); ++i) {
      if (number_[i] == kOpen) flood(i, region);
    }
  }

  bool open(Int3 p) const { return lattice_.has(p) && number_[lattice_.index(p)] != kClosed; }
  bool joined(Int3 a, Int3 b) const {
    return open(a) && open(b) && number_[lattice_.index(a)] == number_[lattice_.index(b)];
  }
  uint64_t samplesOf(Int3 p) const {
    return open(p) ? found_[static_cast<size_t>(number_[lattice_.index(p)])].samples : 0;
  }
  /// The voids in the form of VoidAnswer::voids.
  std::vector<RegionVoid> voids() const {
    std::vector<RegionVoid> sorted = found_;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    return sorted;
  }

  /// The length of the shortest path, in cells. Precondition: the samples are connected.
  double shortest(Int3 from, Int3 to) const {
    std::vector<double> cost(number_.size(), 1e30);
    std::priority_queue<std::pair<double, size_t>> queue;
    cost[lattice_.index(from)] = 0;
    queue.push({0, lattice_.index(from)});
    while (!queue.empty()) {
      const auto [minus, i] = queue.top();
      queue.pop();
      const Int3 p = lattice_.sampleAt(i);
      if (p == to) return -minus;
      if (-minus > cost[i]) continue;
      for (const Int3 step : joiningSteps()) {
        const Int3 next{p.x + step.x, p.y + step.y, p.z + step.z};
        if (!open(next)) continue;
        const double there =
            -minus + std::sqrt(static_cast<double>(step.x * step.x + step.y * step.y + step.z * step.z));
        if (there >= cost[lattice_.index(next)]) continue;
        cost[lattice_.index(next)] = there;
        queue.push({-there, lattice_.index(next)});
      }
    }
    return -1;
  }

 private:
  static constexpr int kClosed = -1, kOpen = -2;

  void flood(size_t from, const IntBox& region) {
    const auto number = static_cast<int>(found_.size());
    RegionVoid whole{0, true};
    std::vector<size_t> waiting{from};
    number_[from] = number;
    while (!waiting.empty()) {
      const Int3 p = lattice_.sampleAt(waiting.back());
      waiting.pop_back();
      ++whole.samples;
      for (int axis = 0; axis < 3; ++axis)
        if (p[axis] == region.lo[axis] || p[axis] == region.hi[axis]) whole.sealed = false;
      for (const Int3 step : joiningSteps()) {
        const Int3 next{p.x + step.x, p.y + step.y, p.z + step.z};
        if (!lattice_.has(next) || number_[lattice_.index(next)] != kOpen) continue;
        number_[lattice_.index(next)] = number;
        waiting.push_back(lattice_.index(next));
      }
    }
    found_.push_back(whole);
  }

  const SampledBox& lattice_;
  std::vector<int> number_;  ///< for each sample, the number of its void
  std::vector<RegionVoid> found_;
};

}  // namespace sgm
