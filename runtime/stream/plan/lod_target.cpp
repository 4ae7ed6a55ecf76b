#include "stream/plan/lod_target.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/chunk.h"

namespace sgm {

namespace {

double edgeOf(int level, int32_t finest_cell) {
  return static_cast<double>(int64_t{kChunkCells} * finest_cell << level);
}

/// Splits the nodes that viewers need in finer detail. A node is tested only against viewers that are near enough to
/// matter. The viewers near each virtual node (root of the octree) are listed first; at each finer level, the list is
/// filtered again.
class TargetBuilder {
 public:
  /// near: distance in units within which nodes of every level are split; 0: each level has its own distance.
  TargetBuilder(Octree& tree, std::span<const LodViewer> viewers, const LodSettings& settings, double near,
                const ChunkSet* finest)
      : tree_(tree), viewers_(viewers), settings_(settings), near_(near), finest_(finest) {}

  void build() {
    std::vector<NearViewer> near_nodes;
    for (uint32_t i = 0; i < viewers_.size(); ++i) listNear(i, near_nodes);
    std::sort(near_nodes.begin(), near_nodes.end());
    for (auto at = near_nodes.begin(); at != near_nodes.end();) {
      const ChunkKey node = at->node;
      askers_.clear();
      for (; at != near_nodes.end() && at->node == node; ++at) askers_.push_back(at->viewer);
      if (wanted(node, 0)) refine(node, 0);
    }
  }

 private:
  struct NearViewer {
    ChunkKey node;
    uint32_t viewer;
    friend auto operator<=>(const NearViewer&, const NearViewer&) = default;
  };

  static int32_t placeOf(double p) {
    // The result is clamped to the world, which has at most 2^26 chunks along an axis.
    return static_cast<int32_t>(std::clamp(std::floor(p), -67108864.0, 67108863.0));
  }

  /// Appends the virtual nodes (roots of the octree) that may have to be split for a viewer. number: index of the
  /// viewer.
  void listNear(uint32_t number, std::vector<NearViewer>& near_nodes) const {
    const LodViewer& viewer = viewers_[number];
    const double edge = edgeOf(settings_.top + 1, settings_.finest_cell);
    // Nodes of the next finer level may have to be split at a larger distance than the virtual node (root) itself.
    const double far = std::max(splitDistance(settings_.top + 1), splitDistance(settings_.top)) * viewer.reach;
    std::array<int32_t, 3> first{}, last{};
    for (size_t axis = 0; axis < 3; ++axis) {
      first[axis] = placeOf((viewer.position[axis] - far) / edge);
      last[axis] = placeOf((viewer.position[axis] + far) / edge);
    }
    for (int32_t z = first[2]; z <= last[2]; ++z) {
      for (int32_t y = first[1]; y <= last[1]; ++y) {
        for (int32_t x = first[0]; x <= last[0]; ++x) near_nodes.push_back({{settings_.top + 1, {x, y, z}}, number});
      }
    }
  }

  /// Returns the distance, in units, within which a node of this level must be split.
  double splitDistance(int level) const {
    if (near_ > 0) return near_;
    if (level > settings_.top) return settings_.view_distance;
    return std::ldexp(settings_.finest_distance, level - 1);
  }

  bool wants(uint32_t viewer, const ChunkKey& node, double within) const {
    const LodViewer& of = viewers_[viewer];
    return distanceToChunk(of.position, node, settings_.finest_cell) < within * of.reach;
  }

  /// True if a viewer in askers_, from index `first` on, needs the node to be split.
  bool wanted(const ChunkKey& node, size_t first) const {
    if (node.level == 1 && finest_ != nullptr && !finest_->contains(node)) return false;
    const double within = splitDistance(node.level);
    return std::any_of(askers_.begin() + static_cast<ptrdiff_t>(first), askers_.end(),
                       [&](uint32_t viewer) { return wants(viewer, node, within); });
  }

  void refine(const ChunkKey& node, size_t first) {
    if (!tree_.split(node) || node.level == 1) return;
    const size_t last = askers_.size();
    const double within = splitDistance(node.level - 1);
    for (int i = 0; i < 8; ++i) {
      const ChunkKey child = childOf(node, i);
      if (child.level == 1 && finest_ != nullptr && !finest_->contains(child)) continue;
      for (size_t at = first; at < last; ++at) {
        if (wants(askers_[at], child, within)) askers_.push_back(askers_[at]);
      }
      if (askers_.size() > last) refine(child, last);
      askers_.resize(last);
    }
  }

  Octree& tree_;
  std::span<const LodViewer> viewers_;
  const LodSettings& settings_;
  double near_;
  const ChunkSet* finest_;
  std::vector<uint32_t> askers_;  ///< stack of viewer indices: the viewers of the current node lie above the viewers of
                                  ///< its ancestors
};

/// Builds the octree of lodTarget() (near = 0), or of nearTarget() with near as its distance.
Octree targetOf(std::span<const LodViewer> viewers, const LodSettings& settings, double near, const ChunkSet* finest) {
  Octree tree(settings.top, settings.finest_cell);
  TargetBuilder(tree, viewers, settings, near, finest).build();
  refineToRules(tree);
  return tree;
}

/// Returns an upper bound of the number of grid cubes with this edge that intersect a ball.
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
