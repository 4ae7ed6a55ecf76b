#include "measure/bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace sgm::measure {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr Bvh::Box kNothing{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

float below(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) > v ? std::nextafter(f, -kInfinity) : f;
}
float above(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) < v ? std::nextafter(f, kInfinity) : f;
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

/// 21 bits, two zeroes after each.
uint64_t spread(uint64_t v) {
  v = (v | v << 32) & 0x001F00000000FFFFu;
  v = (v | v << 16) & 0x001F0000FF0000FFu;
  v = (v | v << 8) & 0x100F00F00F00F00Fu;
  v = (v | v << 4) & 0x10C30C30C30C30C3u;
  return (v | v << 2) & 0x1249249249249249u;
}

/// Where the middle of the box lies in `all`, along a Morton curve.
uint64_t codeOf(const Bvh::Box& box, const Bvh::Box& all) {
  uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = static_cast<double>(all.low[axis]), size = static_cast<double>(all.high[axis]) - low;
    const double middle = 0.5 * (static_cast<double>(box.low[axis]) + static_cast<double>(box.high[axis]));
    const double share = size > 0 ? (middle - low) / size : 0;
    const double step = std::clamp(std::floor(share * 2097152), 0.0, 2097151.0);
    code |= spread(static_cast<uint64_t>(step)) << axis;
  }
  return code;
}

void forBlocks(JobSystem& jobs, size_t count, const std::function<void(size_t, size_t)>& body) {
  parallelFor(jobs, (count + kBlock - 1) / kBlock,
              [&](size_t block) { body(block * kBlock, std::min(count, (block + 1) * kBlock)); });
}

}  // namespace

Bvh::Bvh(const Triangles& mesh, JobSystem& jobs) : order_(mesh.triangles.size()) {
  const size_t count = mesh.triangles.size(), leaves = std::bit_ceil(std::max<size_t>(count, 1));
  boxes_.assign(2 * leaves, kNothing);
  std::vector<Box> of_triangle(count);
  forBlocks(jobs, count, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) of_triangle[i] = boxOf(mesh.points, mesh.triangles[i]);
  });
  Box all = kNothing;
  for (const Box& box : of_triangle) all = joined(all, box);
  std::vector<std::pair<uint64_t, uint32_t>> keys(count);
  forBlocks(jobs, count, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) keys[i] = {codeOf(of_triangle[i], all), static_cast<uint32_t>(i)};
  });
  std::sort(keys.begin(), keys.end());
  for (size_t i = 0; i < count; ++i) {
    order_[i] = keys[i].second;
    boxes_[leaves + i] = of_triangle[order_[i]];
  }
  for (size_t node = leaves - 1; node > 0; --node) boxes_[node] = joined(boxes_[2 * node], boxes_[2 * node + 1]);
}

std::vector<Bvh::Pair> Bvh::parts(size_t parts) const {
  std::vector<Pair> found{{1, 1}};
  while (found.size() < parts) {
    std::vector<Pair> finer;
    bool whole = false;
    for (const Pair& pair : found) {
      // All stand in the same row.
      whole = isLeaf(pair.first);
      if (whole) break;
      split(pair, finer);
    }
    if (whole || finer.empty()) break;
    found = std::move(finer);
  }
  return found;
}

}  // namespace sgm::measure
