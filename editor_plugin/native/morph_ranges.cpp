#include "morph_ranges.h"

#include <cmath>

namespace sgm_godot {
namespace {

constexpr float kNever = 1e9f;

/// Distance in metres from the nearest viewer to the farthest point of a chunk's box. The nearest viewer is the one
/// with the smallest such distance.
float farthest(const sgm_chunk_key& key, const std::vector<Units>& viewers, int32_t cell_units) {
  const double edge = std::ldexp(static_cast<double>(cell_units) * SGM_CHUNK_CELLS, key.level);
  const double corner[3] = {key.x * edge, key.y * edge, key.z * edge};
  double least = INFINITY;
  for (const Units& viewer : viewers) {
    double far = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double low = corner[axis] - viewer[axis], high = low + edge;
      const double outside = std::max(std::abs(low), std::abs(high));
      far += outside * outside;
    }
    least = std::min(least, far);
  }
  return static_cast<float>(std::sqrt(least) / SGM_UNITS_PER_METRE);
}

}  // namespace

MorphRanges morphRanges(const std::vector<Picture::Shown>& shown, const std::vector<Units>& viewers, int32_t cell_units,
                        int32_t top_level) {
  MorphRanges ranges;
  ranges.begin.fill(kNever);
  ranges.end.fill(kNever);
  if (viewers.empty()) return ranges;
  std::array<float, SGM_MAX_LEVEL + 2> finer_ends{};
  for (const Picture::Shown& chunk : shown) {
    if (chunk.seams == 0) continue;
    const float far = farthest(chunk.key, viewers, cell_units);
    const auto level = static_cast<size_t>(chunk.key.level);
    ranges.end[level] = std::min(ranges.end[level], far);
    finer_ends[level + 1] = std::max(finer_ends[level + 1], far);
  }
  for (size_t level = 0; level < ranges.begin.size(); ++level) {
    if (static_cast<int32_t>(level) >= top_level || ranges.end[level] == kNever) {
      ranges.begin[level] = ranges.end[level] = kNever;
      continue;
    }
    // Vertices nearer to the viewer than half of the end distance do not move, so that no movement is visible on near
    // surfaces.
    ranges.begin[level] = std::max(finer_ends[level], ranges.end[level] / 2);
  }
  return ranges;
}

}  // namespace sgm_godot
