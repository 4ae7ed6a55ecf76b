#pragma once
// A graph of the walls between the rooms of a floor plan, along which a corridor may run.

#include <cstdint>
#include <span>
#include <vector>

#include "derive/layout/treemap.h"

namespace sgm {

/// A graph of the centre lines of inner walls. An edge leads from its lower corner to its higher one; edges meet only
/// at corners.
struct WallGraph {
  struct Corner {
    int32_t x = 0, z = 0;
    friend bool operator==(const Corner&, const Corner&) = default;
  };
  struct Edge {
    size_t from = 0, to = 0;
    bool along_x = false;
    int32_t length = 0;
  };
  std::vector<Corner> corners;
  std::vector<Edge> edges;
};

/// Returns the wall graph of a treemap. whole: the treemap's rectangle; cells: the rectangles of its parts.
WallGraph wallGraph(const PlanRect& whole, std::span<const PlanRect> cells);

/// The shortest paths between all pairs of corners (Floyd 1962). walked: a flag for each edge; true: the edge counts as
/// having length 0.
class WallPaths {
 public:
  WallPaths(const WallGraph& graph, const std::vector<bool>& walked);
  /// Sets the flags of the path's edges in `edges`; returns false if there is no path.
  bool walk(size_t from, size_t to, std::vector<bool>& edges) const;
  int64_t length(size_t from, size_t to) const { return length_[from * corners_ + to]; }
  static constexpr int64_t kNone = int64_t{1} << 60;

 private:
  size_t corners_;
  std::vector<int64_t> length_;
  std::vector<size_t> next_;  ///< first edge of the path between each pair of corners; kNoEdge: there is none
  const WallGraph& graph_;
  static constexpr size_t kNoEdge = SIZE_MAX;
};

}  // namespace sgm
