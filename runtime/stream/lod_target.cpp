#include "stream/lod_target.h"

#include <algorithm>
#include <cmath>

#include "mesh/chunk.h"

namespace sgm {

namespace {

double edgeOf(int level, int32_t finest_cell) {
  return static_cast<double>(int64_t{kChunkCells} * finest_cell << level);
}

class TargetBuilder {
 public:
  /// near: the distance within which all levels are split; 0: each has its own.
  TargetBuilder(Octree& tree, std::span<const LodViewer> viewers, const LodSettings& settings, double near,
                const ChunkSet* finest)
      : tree_(tree), viewers_(viewers), settings_(settings), near_(near), finest_(finest) {}

  void addAround(const LodViewer& viewer) {
    const double edge = edgeOf(settings_.top + 1, settings_.finest_cell);
    const double far = splitDistance(settings_.top + 1) * viewer.reach;
    std::array<int32_t, 3> first{}, last{};
    for (size_t axis = 0; axis < 3; ++axis) {
      first[axis] = placeOf((viewer.position[axis] - far) / edge);
      last[axis] = placeOf((viewer.position[axis] + far) / edge);
    }
    for (int32_t z = first[2]; z <= last[2]; ++z) {
      for (int32_t y = first[1]; y <= last[1]; ++y) {
        for (int32_t x = first[0]; x <= last[0]; ++x) {
          const ChunkKey node{settings_.top + 1, {x, y, z}};
          if (!tree_.isSplit(node) && wanted(node)) refine(node);
        }
      }
    }
  }

 private:
  static int32_t placeOf(double p) {
    // The world has at most 2^26 chunks on an axis.
    return static_cast<int32_t>(std::clamp(std::floor(p), -67108864.0, 67108863.0));
  }

  /// Within which distance a node of this level must not be drawn whole.
  double splitDistance(int level) const {
    if (near_ > 0) return near_;
    if (level > settings_.top) return settings_.view_distance;
    return std::ldexp(settings_.finest_distance, level - 1);
  }

  bool wanted(const ChunkKey& node) const {
    if (node.level == 1 && finest_ != nullptr && !finest_->contains(node)) return false;
    const double within = splitDistance(node.level);
    return std::any_of(viewers_.begin(), viewers_.end(), [&](const LodViewer& v) {
      return distanceToChunk(v.position, node, settings_.finest_cell) < within * v.reach;
    });
  }

  void refine(const ChunkKey& node) {
    if (!tree_.split(node) || node.level == 1) return;
    for (int i = 0; i < 8; ++i) {
      const ChunkKey child = childOf(node, i);
      if (wanted(child)) refine(child);
    }
  }

  Octree& tree_;
  std::span<const LodViewer> viewers_;
  const LodSettings& settings_;
  double near_;
  const ChunkSet* finest_;
};

/// near: as TargetBuilder's.
Octree targetOf(std::span<const LodViewer> viewers, const LodSettings& settings, double near, const ChunkSet* finest) {
  Octree tree(settings.top, settings.finest_cell);
  TargetBuilder builder(tree, viewers, settings, near, finest);
  for (const LodViewer& viewer : viewers) builder.addAround(viewer);
  refineToRules(tree);
  return tree;
}

/// How many cubes of an edge a ball meets, at most.
double cubesInBall(double radius, double edge) {
  constexpr double kHalfDiagonal = 0.8660254;
  return 4.0 / 3.0 * 3.141592653589793 * std::pow(radius / edge + kHalfDiagonal, 3);
}

}  // namespace

double expectedLeaves(std::span<const LodViewer> viewers, const LodSettings& settings) {
  double leaves = 0;
  for (const LodViewer& viewer : viewers) {
    const double split = cubesInBall(settings.finest_distance * viewer.reach, edgeOf(1, settings.finest_cell));
    const double roots =
        cubesInBall(settings.view_distance * viewer.reach, edgeOf(settings.top + 1, settings.finest_cell));
    leaves += 8 * (roots + settings.top * split);
  }
  return leaves;
}

double distanceToChunk(const std::array<double, 3>& place, const ChunkKey& key, int32_t finest_cell) {
  const double edge = edgeOf(key.level, finest_cell);
  double squares = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = edge * key.at[axis], at = place[static_cast<size_t>(axis)];
    const double away = std::max({low - at, at - (low + edge), 0.0});
    squares += away * away;
  }
  return std::sqrt(squares);
}

Octree lodTarget(std::span<const LodViewer> viewers, const LodSettings& settings, const ChunkSet* finest) {
  return targetOf(viewers, settings, 0, finest);
}

Octree nearTarget(std::span<const LodViewer> viewers, const LodSettings& settings, double distance,
                  const ChunkSet* finest) {
  return targetOf(viewers, settings, distance, finest);
}

}  // namespace sgm
