#pragma once
// Triangulates arbitrary polygons by ear clipping in the best-fitting plane. Every decision uses the exact sign of an
// area, so that no rounding lets triangles overlap.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asset/point.h"

namespace sgm::asset {

enum class Clipped {
  done,
  crossed,     ///< the polygon crosses itself or has no area: no triangulation is right
  over_limit,  ///< it needs more steps than are left
};

/// Cuts one polygon after another and keeps its memory. An ear is clipped if no other corner lies in it; a k-d tree
/// over the remaining corners finds such corners. A blocked ear waits until the corner that blocks it is gone: n log n
/// steps for typical polygons.
class EarClipping {
 public:
  /// The number of tree boxes that all polygons together may visit: some seconds.
  static constexpr uint64_t kMostSteps = uint64_t{1} << 29;

  explicit EarClipping(uint64_t most_steps = kMostSteps) : most_steps_(most_steps) {}

  /// Replaces `out` by the triangles, two fewer than there are corners, as indices of corners; by the fan of corner 0
  /// if that is right. The plane is that of Newell's normal. Requires at least four corners.
  Clipped run(std::span<const Point> corners, std::vector<std::array<uint32_t, 3>>& out);

 private:
  struct Box {
    double low[2], high[2];
  };
  /// Triangles accepted as ears. strict: with area, and no other corner inside or on the new side; touching: corners
  /// may lie on that side; flat: without area.
  enum class Rule { strict, touching, flat };
  struct Waiting {
    uint32_t corner, next;
  };

  bool project(std::span<const Point> corners);
  int side(uint32_t a, uint32_t b, uint32_t c) const;
  bool fanHolds() const;
  void makeRing();
  void buildTree(uint32_t* first, uint32_t* last, size_t node, size_t leaves, int axis);
  void mergeBoxes(size_t node);
  void removeFromTree(uint32_t corner);
  /// A corner that prevents a, b, c from being an ear; kNone if there is none.
  uint32_t blocker(uint32_t a, uint32_t b, uint32_t c, Rule rule);
  bool blocks(uint32_t corner, const std::array<uint32_t, 3>& ear, Rule rule) const;
  bool isApart(const Box& box, const std::array<uint32_t, 3>& ear) const;
  void enqueue(uint32_t corner);
  void wake(uint32_t corner);
  bool clip(Rule rule, std::vector<std::array<uint32_t, 3>>& out);

  std::vector<Point> points_;  ///< only two of their coordinates are used
  int drop_ = 2, sign_ = 1, u_ = 0, v_ = 1;
  std::vector<uint32_t> next_, previous_, queue_, waiting_first_;
  std::vector<uint32_t> order_, place_, corner_in_;  ///< place_: the tree's node of each corner; corner_in_: of leaves
  std::vector<Waiting> waiting_;
  std::vector<bool> queued_, gone_;
  std::vector<Box> boxes_;
  std::vector<uint32_t> stack_;
  size_t leaves_ = 0, left_ = 0;
  uint64_t steps_ = 0, most_steps_;
};

}  // namespace sgm::asset
