#pragma once
// Polygons of any shape to triangles: ear clipping in the plane that fits best. Every decision is taken by the exact
// sign of an area, so that no rounding lets triangles overlap.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asset/point.h"

namespace sgm::asset {

enum class Clipped {
  done,
  crossed,     ///< the polygon crosses itself or has no area: no triangles are right
  over_limit,  ///< it took more steps than are left
};

/// Cuts one polygon after another; keeps its memory. An ear is clipped where no other corner lies in it; a k-d tree
/// over the corners that are left finds those. A corner that another keeps from being an ear waits until that one is
/// gone: n log n steps for polygons as people draw them.
class EarClipping {
 public:
  /// Boxes of the tree that all polygons together may look at: some seconds.
  static constexpr uint64_t kMostSteps = uint64_t{1} << 29;

  explicit EarClipping(uint64_t most_steps = kMostSteps) : most_steps_(most_steps) {}

  /// Replaces `out` by as many triangles as there are corners, less two, of the corners' numbers; the fan of corner 0
  /// where that one is right. The plane is that of Newell's normal. At least four corners.
  Clipped run(std::span<const Point> corners, std::vector<std::array<uint32_t, 3>>& out);

 private:
  struct Box {
    double low[2], high[2];
  };
  /// Triangles that pass for ears: with area and no other corner on the side that would be new; with corners there;
  /// without area.
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
  /// A corner that keeps a, b, c from being an ear; kNone if there is none.
  uint32_t blocker(uint32_t a, uint32_t b, uint32_t c, Rule rule);
  bool blocks(uint32_t corner, const std::array<uint32_t, 3>& ear, Rule rule) const;
  bool isApart(const Box& box, const std::array<uint32_t, 3>& ear) const;
  void enqueue(uint32_t corner);
  void wake(uint32_t corner);
  bool clip(Rule rule, std::vector<std::array<uint32_t, 3>>& out);

  std::vector<Point> points_;  ///< two of their coordinates count
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
