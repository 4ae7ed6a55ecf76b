#include "stream/plan/view_target.h"

#include <algorithm>
#include <cmath>

#include "mesh/chunk.h"
#include "stream/plan/lod_target.h"

namespace sgm {
namespace {

/// for nodes outside of the picture, the maximum apparent cell size (cell_angle) is larger by this factor
constexpr double kOutOfSight = 4;

class ViewTree {
 public:
  ViewTree(const PictureView& view, const IntBox& region, int top, int32_t finest_cell)
      : view_(view), region_(region), finest_cell_(finest_cell), tree_(top, finest_cell) {}

  Octree build() {
    const int64_t edge = edgeOf(tree_.top() + 1);
    Int3 first, last;
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = static_cast<int32_t>(floorDiv(region_.lo[axis], edge)) - 1;
      last[axis] = static_cast<int32_t>(floorDiv(int64_t{region_.hi[axis]} - 1, edge)) + 1;
    }
    for (int32_t z = first.z; z <= last.z; ++z)
      for (int32_t y = first.y; y <= last.y; ++y)
        for (int32_t x = first.x; x <= last.x; ++x) {
          const ChunkKey node{tree_.top() + 1, {x, y, z}};
          if (!tree_.split(node)) continue;
          for (int i = 0; i < 8; ++i) refine(childOf(node, i));
        }
    refineToRules(tree_);
    return std::move(tree_);
  }

 private:
  int64_t edgeOf(int level) const { return int64_t{kChunkCells} * finest_cell_ << level; }

  bool meetsRegion(const ChunkKey& node) const {
    const int64_t edge = edgeOf(node.level);
    for (int axis = 0; axis < 3; ++axis) {
      if (node.at[axis] * edge >= region_.hi[axis] || (node.at[axis] + 1) * edge <= region_.lo[axis]) return false;
    }
    return true;
  }

  /// True if the cone from the camera through the picture's corners intersects the bounding sphere of the node.
  bool inSight(const ChunkKey& node) const {
    const auto edge = static_cast<double>(edgeOf(node.level));
    double along = 0, square = 0, length = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double away = (node.at[static_cast<int>(axis)] + 0.5) * edge - view_.position[axis];
      along += away * view_.direction[axis];
      square += away * away;
      length += view_.direction[axis] * view_.direction[axis];
    }
    const double distance = std::sqrt(square), radius = edge * std::sqrt(0.75);
    if (distance <= radius) return true;
    const double angle = std::acos(std::clamp(along / (distance * std::sqrt(length)), -1.0, 1.0));
    return angle <= view_.half_angle + std::asin(radius / distance);
  }

  void refine(const ChunkKey& node) {
    if (node.level == 0 || !meetsRegion(node)) return;
    const double cell = static_cast<double>(int64_t{finest_cell_} << node.level);
    const double widest = view_.cell_angle * (inSight(node) ? 1 : kOutOfSight);
    if (cell <= widest * distanceToChunk(view_.position, node, finest_cell_)) return;
    if (!tree_.split(node)) return;
    for (int i = 0; i < 8; ++i) refine(childOf(node, i));
  }

  const PictureView& view_;
  const IntBox& region_;
  int32_t finest_cell_;
  Octree tree_;
};

}  // namespace

int halvingsFor(const PictureView& view, int32_t coarsest, int32_t finest, double nearest) {
  int halvings = 0;
  for (int32_t cell = coarsest; cell / 2 >= finest && cell > view.cell_angle * nearest && halvings < kMaxLevel;
       cell /= 2)
    ++halvings;
  return halvings;
}

Octree viewTarget(const PictureView& view, const IntBox& region, int top, int32_t finest_cell) {
  return ViewTree(view, region, top, finest_cell).build();
}

}  // namespace sgm
