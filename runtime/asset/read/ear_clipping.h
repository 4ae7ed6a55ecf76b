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
  crossed,     ///< the polygon crosses itself or has no area, so no triangulation is correct
  over_limit,  ///< the polygon needs more steps than are left of kMaxSteps
};

/// Triangulates one polygon after another, and reuses its memory. An ear is clipped if no other corner of the polygon
/// lies in it; a k-d tree over the remaining corners finds such corners. A blocked ear is tested again when the corner
/// that blocks it is gone: n log n steps for typical polygons.
class EarClipping {
 public:
  /// The maximum number of boxes of k-d trees that are visited for all polygons together; they take some seconds.
  static constexpr uint64_t kMaxSteps = uint64_t{1} << 29;

  explicit EarClipping(uint64_t max_steps = kMaxSteps) : max_steps_(max_steps) {}

  /// Replaces `out` by the triangles, two fewer than there are corners, as indices of corners. Uses the fan around
  /// corner 0 if it is correct. Projects along Newell's normal. Requires at least four corners.
  Clipped run(std::span<const Point> corners, std::vector<std::array<uint32_t, 3>>& out);

 private:
  struct Box {
    double low[2], high[2];
  };
  /// Which triangles are clipped as ears. strict: with area, and without another corner inside or on the new side;
  /// touching: other corners may lie on the new side; flat: triangles without area.
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
  /// Returns a corner that prevents the triangle a, b, c from being an ear; kNone if there is none.
  uint32_t blocker(uint32_t a, uint32_t b, uint32_t c, Rule rule);
  bool blocks(uint32_t corner, const std::array<uint32_t, 3>& ear, Rule rule) const;
  bool isApart(const Box& box, const std::array<uint32_t, 3>& ear) const;
  void enqueue(uint32_t corner);
  void wake(uint32_t corner);
  bool clip(Rule rule, std::vector<std::array<uint32_t, 3>>& out);

  std::vector<Point> points_;  ///< two of the three coordinates are used
  int drop_ = 2, sign_ = 1, u_ = 0, v_ = 1;
  std::vector<uint32_t> next_, previous_, queue_, waiting_first_;
  /// place_: the tree node of each corner; corner_in_: the corner in each leaf
  std::vector<uint32_t> order_, place_, corner_in_;
  std::vector<Waiting> waiting_;
  std::vector<bool> queued_, gone_;
  std::vector<Box> boxes_;
  std::vector<uint32_t> stack_;
  size_t leaves_ = 0, left_ = 0;
  uint64_t steps_ = 0, max_steps_;
};

}  // namespace sgm::asset
