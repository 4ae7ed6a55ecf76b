#include "measure/area_volume.h"

#include <algorithm>
#include <vector>

namespace sgm::measure {
namespace {

struct Sums {
  double area = 0, six_volumes = 0;
  Point cross;
};

Sums sumsOf(const Triangles& mesh, size_t begin, size_t end, Point centre) {
  Sums sums;
  for (size_t i = begin; i < end; ++i) {
    const Triangle& t = mesh.triangles[i];
    const Point a = mesh.points[t[0]] - centre, b = mesh.points[t[1]] - centre, c = mesh.points[t[2]] - centre;
    const Point cross = crossOf(a, b, c);
    sums.area += length(cross);
    sums.cross = sums.cross + cross;
    // The triple product a . (b x c), computed as a . ((b - a) x (c - a)), which loses fewer digits.
    sums.six_volumes += dot(a, cross);
  }
  return sums;
}

}  // namespace

AreaVolume areaVolume(const Triangles& mesh, JobSystem& jobs) {
  AreaVolume result;
  if (mesh.triangles.empty()) return result;
  const size_t blocks = (mesh.triangles.size() + kBlock - 1) / kBlock;
  const auto each = [&](auto&& body) {
    parallelFor(jobs, blocks, [&](size_t block) {
      body(block, block * kBlock, std::min(mesh.triangles.size(), (block + 1) * kBlock));
    });
  };
  struct Bounds {
    Point low, high;
  };
  std::vector<Bounds> bounds(blocks);
  each([&](size_t block, size_t begin, size_t end) {
    const Point first = mesh.points[mesh.triangles[begin][0]];
    Bounds found{first, first};
    for (size_t i = begin; i < end; ++i) {
      for (const uint32_t v : mesh.triangles[i]) {
        for (int axis = 0; axis < 3; ++axis) {
          found.low[axis] = std::min(found.low[axis], mesh.points[v][axis]);
          found.high[axis] = std::max(found.high[axis], mesh.points[v][axis]);
        }
      }
    }
    bounds[block] = found;
  });
  result.low = bounds.front().low;
  result.high = bounds.front().high;
  for (const Bounds& b : bounds) {
    for (int axis = 0; axis < 3; ++axis) {
      result.low[axis] = std::min(result.low[axis], b.low[axis]);
      result.high[axis] = std::max(result.high[axis], b.high[axis]);
    }
  }
  // Both corners are halved before the addition, because the sum of two large coordinates may overflow.
  result.centre = 0.5 * result.low + 0.5 * result.high;
  std::vector<Sums> sums(blocks);
  each([&](size_t block, size_t begin, size_t end) { sums[block] = sumsOf(mesh, begin, end, result.centre); });
  for (const Sums& s : sums) {
    result.area += 0.5 * s.area;
    result.area_vector = result.area_vector + 0.5 * s.cross;
    result.volume += s.six_volumes / 6;
  }
  return result;
}

}  // namespace sgm::measure
