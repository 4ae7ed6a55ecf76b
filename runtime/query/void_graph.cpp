#include "query/void_graph.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>

namespace sgm {

namespace {

double between(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

}  // namespace

VoidGraph::VoidGraph(const ChunkOrder& order, bool ways, std::pmr::memory_resource* memory)
    : order_(order),
      ways_(ways),
      memory_(memory),
      first_(memory),
      parent_(memory),
      samples_(memory),
      open_(memory),
      portals_(memory),
      awaiting_{std::pmr::vector<OpenFace>(memory), std::pmr::vector<OpenFace>(memory),
                std::pmr::vector<OpenFace>(memory)} {
  for (int axis = 0; axis < 3; ++axis) {
    for (uint64_t i = 0; i < order.stride(axis); ++i)
      awaiting_[static_cast<size_t>(axis)].push_back({FaceVoids(memory), 0});
  }
}

uint32_t VoidGraph::chunkOf(uint32_t number) const {
  return static_cast<uint32_t>(std::upper_bound(first_.begin(), first_.end(), number) - first_.begin() - 1);
}

uint32_t VoidGraph::rootOf(uint32_t number) {
  while (parent_[number] != number) number = parent_[number] = parent_[parent_[number]];
  return number;
}

bool VoidGraph::add(ChunkVoids chunk) {
  const size_t first = parent_.size();
  if (first + chunk.voids.size() > std::numeric_limits<uint32_t>::max()) return false;
  const size_t number = first_.size();
  const Int3 at = order_.at(number), counts = order_.counts();
  uint8_t border = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (at[axis] == 0) border |= static_cast<uint8_t>(1 << 2 * axis);
    if (at[axis] + 1 == counts[axis]) border |= static_cast<uint8_t>(2 << 2 * axis);
  }
  first_.push_back(static_cast<uint32_t>(first));
  for (const ChunkVoids::Void& v : chunk.voids) {
    parent_.push_back(static_cast<uint32_t>(parent_.size()));
    samples_.push_back(v.samples);
    open_.push_back((v.faces & border) != 0);
  }
  const Int3 corner{at.x * kChunkCells, at.y * kChunkCells, at.z * kChunkCells};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    OpenFace& before = awaiting_[a][number % awaiting_[a].size()];
    if (at[axis] > 0) join(before, chunk.faces[2 * a], axis, corner);
    before = {std::move(chunk.faces[2 * a + 1]), static_cast<uint32_t>(first)};
  }
  return true;
}

void VoidGraph::join(const OpenFace& low, const FaceVoids& high, int axis, Int3 corner) {
  if (low.voids.empty() || high.empty()) return;
  const int first_axis = axis == 0 ? 1 : 0, second_axis = axis == 2 ? 1 : 2;
  std::map<std::pair<uint32_t, uint32_t>, Portal> shared;
  std::pair<uint32_t, uint32_t> last{};
  Portal* portal = nullptr;
  for (size_t i = 0; i < high.size(); ++i) {
    // Both chunks contain this sample, so it suffices to test whether it is free in one of them.
    if (high[i] == 0) continue;
    const std::pair<uint32_t, uint32_t> pair{low.first + low.voids[i] - 1, first_.back() + high[i] - 1};
    if (portal == nullptr || pair != last) {
      last = pair;
      portal = &shared[pair];
    }
    portal->middle[static_cast<size_t>(first_axis)] += static_cast<double>(i % kChunkSamples);
    portal->middle[static_cast<size_t>(second_axis)] += static_cast<double>(i / kChunkSamples);
    ++portal->samples;
  }
  for (auto& [pair, found] : shared) {
    const uint32_t a = rootOf(pair.first), b = rootOf(pair.second);
    parent_[std::max(a, b)] = std::min(a, b);
    if (!ways_) continue;
    found.sides = {pair.first, pair.second};
    for (int i = 0; i < 3; ++i) {
      double& middle = found.middle[static_cast<size_t>(i)];
      middle = corner[i] + middle / found.samples;
    }
    portals_.push_back(found);
  }
}

uint64_t VoidGraph::samplesOf(uint32_t number) {
  uint64_t samples = 0;
  for (uint32_t i = 0; i < parent_.size(); ++i) samples += joined(i, number) ? samples_[i] : 0;
  return samples;
}

std::vector<RegionVoid> VoidGraph::voids() {
  std::pmr::vector<RegionVoid> by_root(parent_.size(), {0, true}, memory_);
  for (uint32_t i = 0; i < parent_.size(); ++i) {
    RegionVoid& whole = by_root[rootOf(i)];
    whole.samples += samples_[i];
    whole.sealed = whole.sealed && open_[i] == 0;
  }
  std::vector<RegionVoid> found;
  for (uint32_t i = 0; i < parent_.size(); ++i) {
    if (parent_[i] == i) found.push_back(by_root[i]);
  }
  std::sort(found.begin(), found.end(), std::greater<>());
  return found;
}

std::vector<std::vector<uint32_t>> VoidGraph::portalsByVoid() const {
  std::vector<std::vector<uint32_t>> by_void(parent_.size());
  for (uint32_t p = 0; p < portals_.size(); ++p) {
    for (const uint32_t side : portals_[p].sides) by_void[side].push_back(p);
  }
  return by_void;
}

std::vector<uint32_t> VoidGraph::chunksOfWay(uint32_t a, Int3 from, uint32_t b, Int3 to) const {
  const Place start{static_cast<double>(from.x), static_cast<double>(from.y), static_cast<double>(from.z)};
  const Place end{static_cast<double>(to.x), static_cast<double>(to.y), static_cast<double>(to.z)};
  const std::vector<std::vector<uint32_t>> portals = portalsByVoid();
  // A* search (Hart, Nilsson, Raphael). A step of the search leads through a portal to one of the portal's two sides.
  // The number of the step is 2 * portal + side. The lower bound of the remaining cost is the straight distance to the
  // end.
  constexpr uint32_t kFirstStep = std::numeric_limits<uint32_t>::max();
  std::vector<double> cost(2 * portals_.size(), std::numeric_limits<double>::infinity());
  std::vector<uint32_t> before(2 * portals_.size(), kFirstStep);
  using Entry = std::tuple<double, double, uint32_t>;  // lower bound of the total cost, cost so far, step
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto leave = [&](uint32_t inside, const Place& place, double so_far, uint32_t step) {
    for (const uint32_t p : portals[inside]) {
      const Portal& portal = portals_[p];
      const uint32_t next = 2 * p + (portal.sides[0] == inside ? 1 : 0);
      const double there = so_far + between(place, portal.middle);
      if (there >= cost[next]) continue;
      cost[next] = there;
      before[next] = step;
      queue.push({there + between(portal.middle, end), there, next});
    }
  };
  // The path may end in any step that leads into the void b. `best` is the total cost of the cheapest path to b found
  // so far.
  double best = a == b ? between(start, end) : std::numeric_limits<double>::infinity();
  uint32_t last = kFirstStep;
  leave(a, start, 0, kFirstStep);
  while (!queue.empty()) {
    const auto [estimate, so_far, step] = queue.top();
    queue.pop();
    if (estimate >= best) break;
    if (so_far > cost[step]) continue;
    const Portal& portal = portals_[step / 2];
    const uint32_t inside = portal.sides[step % 2];
    if (inside == b && estimate < best) {
      best = estimate;
      last = step;
    }
    leave(inside, portal.middle, so_far, step);
  }
  std::vector<uint32_t> chunks;
  for (uint32_t step = last; step != kFirstStep; step = before[step])
    chunks.push_back(chunkOf(portals_[step / 2].sides[step % 2]));
  chunks.push_back(chunkOf(a));
  std::reverse(chunks.begin(), chunks.end());
  return chunks;
}

}  // namespace sgm
