#include "measure/bvh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace sgm::measure {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr Bvh::Box kNothing{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

/// Returns a float that is certainly below v: one step lower than the rounded value, which may lie above v.
/// std::nextafter takes ten times as long.
float below(double v) {
  const auto f = static_cast<float>(v);
  return f - std::fabs(f) * std::numeric_limits<float>::epsilon() - std::numeric_limits<float>::min();
}
float above(double v) {
  const auto f = static_cast<float>(v);
  return f + std::fabs(f) * std::numeric_limits<float>::epsilon() + std::numeric_limits<float>::min();
}

Bvh::Box joined(const Bvh::Box& a, const Bvh::Box& b) {
  Bvh::Box box{};
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(a.low[axis], b.low[axis]);
    box.high[axis] = std::max(a.high[axis], b.high[axis]);
  }
  return box;
}

Bvh::Box boxOf(std::span<const Point> points, const Triangle& t) {
  Bvh::Box box = kNothing;
  for (const uint32_t v : t) {
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], below(points[v][axis]));
      box.high[axis] = std::max(box.high[axis], above(points[v][axis]));
    }
  }
  return box;
}

/// Spreads the 10 low bits of v, with two zero bits after each, for a Morton code.
uint32_t spread(uint32_t v) {
  v = (v | v << 16) & 0x030000FFu;
  v = (v | v << 8) & 0x0300F00Fu;
  v = (v | v << 4) & 0x030C30C3u;
  return (v | v << 2) & 0x09249249u;
}

float middleOf(const Bvh::Box& box, int axis) { return 0.5f * box.low[axis] + 0.5f * box.high[axis]; }

/// Returns a box around most of the triangles. In a box around all of them, a few distant triangles could squeeze all
/// others into one step of the Morton curve.
Bvh::Box coreOf(const Triangles& mesh) {
  constexpr size_t kSamples = 4096;
  const size_t step = mesh.triangles.size() / kSamples + 1;
  std::array<std::vector<float>, 3> middles;
  for (size_t i = 0; i < mesh.triangles.size(); i += step) {
    const Bvh::Box box = boxOf(mesh.points, mesh.triangles[i]);
    for (int axis = 0; axis < 3; ++axis) middles[static_cast<size_t>(axis)].push_back(middleOf(box, axis));
  }
  Bvh::Box core = kNothing;
  for (size_t axis = 0; axis < 3 && !middles[axis].empty(); ++axis) {
    std::sort(middles[axis].begin(), middles[axis].end());
    const size_t last = middles[axis].size() - 1, beside = last / 50;
    const float low = middles[axis][beside], high = middles[axis][last - beside], more = 0.1f * (high - low);
    core.low[axis] = low - more;
    core.high[axis] = high + more;
  }
  return core;
}

/// Returns the Morton code of the middle of a box, with 1024 steps per axis of `core`; clamped to the core's border.
uint32_t codeOf(const Bvh::Box& box, const Bvh::Box& core) {
  uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float size = core.high[axis] - core.low[axis], middle = middleOf(box, axis) - core.low[axis];
    const float step = size > 0 && middle > 0 ? std::min(middle / size * 1024, 1023.0f) : 0;
    code |= spread(static_cast<uint32_t>(step)) << axis;
  }
  return code;
}

/// Sorts keys by the Morton code in their upper bits; keys with equal codes keep their order. A radix sort in three
/// passes of 10 bits, in a third of the time of std::sort.
void sortByCode(LargeVector<uint64_t>& keys) {
  LargeVector<uint64_t> sorted(keys.size(), keys.get_allocator());
  for (const int shift : {32, 42, 52}) {
    const auto digit = [shift](uint64_t key) { return key >> shift & 1023; };
    std::array<size_t, 1024> next{};
    for (const uint64_t key : keys) ++next[digit(key)];
    size_t before = 0;
    for (size_t& n : next) before += std::exchange(n, before);
    for (const uint64_t key : keys) sorted[next[digit(key)]++] = key;
    keys.swap(sorted);
  }
}

void forBlocks(JobSystem& jobs, size_t count, const std::function<void(size_t, size_t)>& body) {
  parallelFor(jobs, (count + kBlock - 1) / kBlock,
              [&](size_t block) { body(block * kBlock, std::min(count, (block + 1) * kBlock)); });
}

}  // namespace

Bvh::Bvh(const Triangles& mesh, JobSystem& jobs) : boxes_(mesh.memory), order_(mesh.triangles.size(), mesh.memory) {
  const size_t count = mesh.triangles.size(), leaves = std::bit_ceil(std::max<size_t>(count, 1));
  const Box core = coreOf(mesh);
  // Boxes are computed twice instead of being stored, because touching a fresh page of memory takes longer than
  // computing its boxes. A key has the Morton code in its upper bits and the triangle's number in its lower bits.
  LargeVector<uint64_t> keys(count, mesh.memory);
  forBlocks(jobs, count, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      keys[i] = uint64_t{codeOf(boxOf(mesh.points, mesh.triangles[i]), core)} << 32 | i;
  });
  sortByCode(keys);
  boxes_.resize(2 * leaves, kNothing);
  forBlocks(jobs, count, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      order_[i] = static_cast<uint32_t>(keys[i]);
      boxes_[leaves + i] = boxOf(mesh.points, mesh.triangles[order_[i]]);
    }
  });
  for (size_t node = leaves - 1; node > 0; --node) boxes_[node] = joined(boxes_[2 * node], boxes_[2 * node + 1]);
}

std::vector<Bvh::Pair> Bvh::parts(size_t parts) const {
  std::vector<Pair> found{{1, 1}};
  while (found.size() < parts) {
    std::vector<Pair> finer;
    bool whole = false;
    for (const Pair& pair : found) {
      // The nodes of all pairs are on the same level of the tree, so if one pair consists of leaves, all do.
      whole = isLeaf(pair.first);
      if (whole) break;
      std::array<Pair, 4> children;
      finer.insert(finer.end(), children.begin(), children.begin() + split(pair, children.data()));
    }
    if (whole || finer.empty()) break;
    found = std::move(finer);
  }
  return found;
}

}  // namespace sgm::measure
