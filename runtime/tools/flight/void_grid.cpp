#include "tools/flight/void_grid.h"

#include <algorithm>
#include <cstdlib>
#include <queue>
#include <tuple>

#include "base/hash.h"

namespace sgm::cli {
namespace {

constexpr int32_t kWorldEnd = 2'000'000 * kUnitsPerMetre;
constexpr size_t kMaxBlocks = size_t{1} << 16;  // maximum number of cached blocks; each block takes half a kilobyte

constexpr int32_t floorDivide(int32_t a, int32_t b) { return static_cast<int32_t>(floorDiv(a, b)); }

/// Cost of a step to a neighbouring node, in tenths of a step; the index is the number of axes on which the two nodes
/// differ.
constexpr std::array<int64_t, 4> kStepCost{0, 10, 14, 17};

}  // namespace

size_t PlaceHash::operator()(const Int3& p) const {
  return hashCombine(uint64_t{static_cast<uint32_t>(p.x)} << 32 | static_cast<uint32_t>(p.y),
                     static_cast<uint32_t>(p.z));
}

Result<std::vector<bool>> solidAt(sgm_field* field, std::span<const Int3> points) {
  std::vector<int32_t> q(points.size());
  static_assert(sizeof(Int3) == 3 * sizeof(int32_t));
  sgm_sample_desc desc = SGM_SAMPLE_DESC_INIT;
  desc.points = points.empty() ? nullptr : &points[0].x;
  desc.count = points.size();
  desc.q = q.data();
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_field_sample(field, &desc, &error) != SGM_OK) return Error{Code::limit, error.message};
  std::vector<bool> solid(points.size());
  for (size_t i = 0; i < q.size(); ++i) solid[i] = q[i] < 0;
  return solid;
}

Int3 VoidGrid::placeOf(Int3 node) const {
  Int3 place;
  for (int axis = 0; axis < 3; ++axis) place[axis] = saturate(int64_t{node[axis]} * step_ + 5 * step_ / 8);
  return place;
}

Int3 VoidGrid::nodeAt(Int3 place) const {
  Int3 node;
  for (int axis = 0; axis < 3; ++axis)
    node[axis] = static_cast<int32_t>(floorDiv(int64_t{place[axis]} - 5 * step_ / 8 + step_ / 2, step_));
  return node;
}

bool VoidGrid::isClear(Int3 node) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(int64_t{node[axis]}) * step_ > kWorldEnd) return false;
  if (error_ || blocked_.count(node) != 0) return false;
  Int3 at, in;
  for (int axis = 0; axis < 3; ++axis) {
    at[axis] = floorDivide(node[axis], kBlock);
    in[axis] = node[axis] - at[axis] * kBlock;
  }
  return blockAt(at)[static_cast<size_t>(in.x + kBlock * (in.y + kBlock * in.z))];
}

const VoidGrid::Block& VoidGrid::blockAt(Int3 at) {
  // Most calls ask for the same block as the previous call.
  if (latest_ != nullptr && latest_at_ == at) return *latest_;
  latest_at_ = at;
  const auto known = blocks_.find(at);
  if (known != blocks_.end()) return *(latest_ = &known->second);
  if (blocks_.size() >= kMaxBlocks) blocks_.clear();
  constexpr int kSide = kBlock + 2;
  std::vector<Int3> points;
  points.reserve(kSide * kSide * kSide);
  for (int z = -1; z <= kBlock; ++z)
    for (int y = -1; y <= kBlock; ++y)
      for (int x = -1; x <= kBlock; ++x)
        points.push_back(placeOf({at.x * kBlock + x, at.y * kBlock + y, at.z * kBlock + z}));
  const Result<std::vector<bool>> solid = solidAt(field_, points);
  Block& block = blocks_[at];
  latest_ = &block;
  if (!solid) {
    error_ = solid.error();
    return block;
  }
  // Dilates the solid by one node, one axis after another, so that a node is clear only if its 26 neighbours are in the
  // void.
  std::vector<bool> blocked = *solid;
  for (const int stride : {1, kSide, kSide * kSide}) {
    const std::vector<bool> before = blocked;
    for (int i = stride; i + stride < static_cast<int>(blocked.size()); ++i)
      blocked[static_cast<size_t>(i)] = before[static_cast<size_t>(i)] || before[static_cast<size_t>(i - stride)] ||
                                        before[static_cast<size_t>(i + stride)];
  }
  for (int z = 0; z < kBlock; ++z)
    for (int y = 0; y < kBlock; ++y)
      for (int x = 0; x < kBlock; ++x)
        block[static_cast<size_t>(x + kBlock * (y + kBlock * z))] =
            !blocked[static_cast<size_t>(x + 1 + kSide * (y + 1 + kSide * (z + 1)))];
  return block;
}

std::optional<Int3> VoidGrid::nearestClear(Int3 node, int radius) {
  std::optional<Int3> nearest;
  int64_t least = 0;
  for (int z = -radius; z <= radius; ++z) {
    for (int y = -radius; y <= radius; ++y) {
      for (int x = -radius; x <= radius; ++x) {
        const int64_t distance = int64_t{x} * x + y * y + z * z;
        const Int3 other{node.x + x, node.y + y, node.z + z};
        if ((nearest && distance >= least) || !isClear(other)) continue;
        nearest = other;
        least = distance;
      }
    }
  }
  return nearest;
}

VoidSearch::VoidSearch(VoidGrid& grid, Int3 from, size_t most, const std::function<int64_t(Int3)>& guess,
                       const std::function<bool(Int3, int64_t)>& visit) {
  // A queued node: its estimated total cost (cost so far plus guess), and its position. Nodes of equal cost are ordered
  // by position, so that the search is deterministic.
  using Entry = std::tuple<int64_t, Int3>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto left = [&](Int3 node) { return guess ? guess(node) : 0; };
  reached_[from] = {0, from, false};
  queue.push({left(from), from});
  for (size_t visited = 0; !queue.empty() && visited < most;) {
    const Int3 node = std::get<1>(queue.top());
    queue.pop();
    Reached& here = reached_[node];
    if (here.done) continue;
    here.done = true;
    ++visited;
    const int64_t cost = here.cost;
    if (!visit(node, cost)) return;
    // Steps beside walls cost twice as much, so that paths keep to the middle of the void.
    int walls = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Int3 beside = node;
        beside[axis] += side;
        walls += !grid.isClear(beside);
      }
    }
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const Int3 to{node.x + x, node.y + y, node.z + z};
          if (to == node) continue;
          const int64_t step = kStepCost[static_cast<size_t>(std::abs(x) + std::abs(y) + std::abs(z))];
          const int64_t there = cost + (walls > 0 ? 2 * step : step);
          const auto known = reached_.find(to);
          if (known != reached_.end() ? known->second.done || known->second.cost <= there : !grid.isClear(to)) continue;
          reached_[to] = {there, node, false};
          queue.push({there + left(to), to});
        }
      }
    }
  }
}

std::vector<Int3> VoidSearch::wayTo(Int3 node) const {
  std::vector<Int3> way{node};
  for (Int3 at = node; reached_.at(at).from != at;) way.push_back(at = reached_.at(at).from);
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace sgm::cli
