#include "stream/plan/viewer_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/chunk.h"

namespace sgm {

namespace {

constexpr uint32_t kMaxInLeaf = 4;
/// Maximum depth of the hierarchy. A hierarchy of kMaxViewers viewers is less deep.
constexpr size_t kDeepest = 32;

double boxDistance(const std::array<double, 3>& low, const std::array<double, 3>& high, const ChunkKey& key,
                   double edge) {
  double squares = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<size_t>(axis);
    const double from = edge * key.at[axis];
    const double away = std::max({from - high[i], low[i] - (from + edge), 0.0});
    squares += away * away;
  }
  return std::sqrt(squares);
}

/// Factor by which lower bounds are reduced, so that they stay valid despite rounding errors.
constexpr double kCareful = 1 - 1e-9;

}  // namespace

ViewerIndex::ViewerIndex(std::span<const Viewer> viewers, const LodSettings& settings, double all_around)
    : settings_(settings), all_around_(all_around) {
  seen_.reserve(viewers.size());
  for (const Viewer& viewer : viewers) seen_.emplace_back(viewer);
  nodes_.reserve(viewers.size());
  if (!seen_.empty()) build(0, static_cast<uint32_t>(seen_.size()));
}

uint32_t ViewerIndex::build(uint32_t first, uint32_t count) {
  const auto at = static_cast<uint32_t>(nodes_.size());
  Node node{seen_[first].viewer.position, seen_[first].viewer.position, 0, first, count, 0};
  for (const SeenBy& seen : std::span(seen_).subspan(first, count)) {
    for (size_t axis = 0; axis < 3; ++axis) {
      node.low[axis] = std::min({node.low[axis], seen.viewer.position[axis], seen.soon[axis]});
      node.high[axis] = std::max({node.high[axis], seen.viewer.position[axis], seen.soon[axis]});
    }
    node.reach = std::max(node.reach, seen.reach);
  }
  nodes_.push_back(node);
  if (count <= kMaxInLeaf) return at;
  size_t longest = 0;
  for (size_t axis = 1; axis < 3; ++axis) {
    if (node.high[axis] - node.low[axis] > node.high[longest] - node.low[longest]) longest = axis;
  }
  const uint32_t half = count / 2;
  const auto begin = seen_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [longest](const SeenBy& a, const SeenBy& b) {
    return a.viewer.position[longest] < b.viewer.position[longest];
  });
  build(first, half);
  const uint32_t second = build(first + half, count - half);
  nodes_[at].second_child = second;
  return at;
}

template <class Bound, class Value>
double ViewerIndex::least(const Bound& bound, const Value& value) const {
  double least = std::numeric_limits<double>::infinity();
  if (nodes_.empty()) return least;
  std::array<std::pair<double, uint32_t>, kDeepest> open;
  size_t count = 0;
  open[count++] = {bound(nodes_[0]), 0};
  while (count > 0) {
    const auto [at_least, at] = open[--count];
    if (at_least >= least) continue;
    const Node& node = nodes_[at];
    if (node.second_child == 0) {
      for (const SeenBy& seen : std::span(seen_).subspan(node.first, node.count)) least = std::min(least, value(seen));
      continue;
    }
    std::pair<double, uint32_t> near{bound(nodes_[at + 1]), at + 1},
        far{bound(nodes_[node.second_child]), node.second_child};
    if (far.first < near.first) std::swap(near, far);
    open[count++] = far;
    open[count++] = near;
  }
  return least;
}

double ViewerIndex::urgency(const ChunkKey& key) const {
  const double edge = std::ldexp(static_cast<double>(kChunkCells) * settings_.finest_cell, key.level);
  const double wanted_within = std::ldexp(settings_.finest_distance, key.level);
  return least(
      [&](const Node& node) {
        return kCareful * boxDistance(node.low, node.high, key, edge) / (wanted_within * node.reach);
      },
      [&](const SeenBy& seen) { return urgencyFor(key, seen, settings_, all_around_); });
}

double ViewerIndex::distance(const ChunkKey& key) const {
  const double edge = std::ldexp(static_cast<double>(kChunkCells) * settings_.finest_cell, key.level);
  return least([&](const Node& node) { return kCareful * boxDistance(node.low, node.high, key, edge); },
               [&](const SeenBy& seen) { return distanceToChunk(seen.viewer.position, key, settings_.finest_cell); });
}

}  // namespace sgm
