#include "tools/cli/measure/drawing_cost.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sgm::cli {

DrawingCost drawingCost(const measure::Triangles& mesh) {
  using measure::Point;
  DrawingCost cost;
  if (mesh.triangles.size() > std::numeric_limits<int32_t>::max() / 3) return cost;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr uint32_t kUnused = 0xFFFFFFFFu;
  Point low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  std::vector<uint32_t> number(mesh.points.size(), kUnused), indices;
  indices.reserve(3 * mesh.triangles.size());
  uint32_t vertices = 0;
  const auto finite = [&](uint32_t v) {
    const Point p = mesh.points[v];
    return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= measure::kFarthest;
  };
  std::vector<Point> used;
  for (const measure::Triangle& t : mesh.triangles) {
    if (!std::all_of(t.begin(), t.end(), finite)) continue;
    for (const uint32_t v : t) {
      if (number[v] == kUnused) {
        number[v] = vertices++;
        const Point p = mesh.points[v];
        used.push_back(p);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
      indices.push_back(number[v]);
    }
  }
  if (indices.empty()) return cost;
  // Positions are made relative to the mesh's corner and divided by its size: far from the origin, single precision
  // would merge different vertices.
  const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const double scale = size > 0 ? 1 / size : 0;
  std::vector<float> positions;
  positions.reserve(3 * used.size());
  for (const Point& p : used) {
    for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>((p[axis] - low[axis]) * scale));
  }
  const auto cache = meshopt_analyzeVertexCache(indices.data(), indices.size(), vertices, kVertexCache, 0, 0);
  const auto drawn =
      meshopt_analyzeOverdraw(indices.data(), indices.size(), positions.data(), vertices, 3 * sizeof(float));
  cost.triangles = indices.size() / 3;
  cost.acmr = static_cast<double>(cache.acmr);
  cost.atvr = static_cast<double>(cache.atvr);
  cost.overdraw = static_cast<double>(drawn.overdraw);
  return cost;
}

}  // namespace sgm::cli
