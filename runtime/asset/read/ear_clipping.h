#pragma once
// Triangulates any simple polygon by ear clipping in its best-fitting plane. Every decision uses the exact sign of an
// area, so rounding errors cannot make triangles overlap.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asset/point.h"

namespace sgm::asset {

enum class Clipped {
  done,
  crossed,     ///< the polygon is self-intersecting or has no area, so no triangulation is correct
  over_limit,  ///< the step limit kMaxSteps, which all polygons share, is exceeded
};

/// Triangulates one polygon after another, and reuses its memory. An ear is clipped if it contains no other corner of
/// the polygon; a k-d tree of the remaining corners finds such corners. If a corner blocks an ear, the ear is tested
/// again when that corner has been clipped. Takes n log n steps for typical polygons.
class EarClipping {
 public:
  /// Limit on the number of visits to k-d tree nodes, for all polygons together; so many visits take some seconds.
  static constexpr uint64_t kMaxSteps = uint64_t{1} << 29;

  explicit EarClipping(uint64_t max_steps = kMaxSteps) : max_steps_(max_steps) {}

  /// Replaces `out` by the triangles of one polygon, as indices into `corners`; there are two fewer triangles than
  /// corners. Uses the fan around corner 0 if it is correct. Projects along Newell's normal. Requires at least four
  /// corners.
  Clipped run(std::span<const Point> corners, std::vector<std::array<uint32_t, 3>>& out);

 private:
  struct Box {
    double low[2], high[2];
  };
  /// Selects the triangles that may be clipped as ears. strict: not degenerate, and no other corner lies inside or on
  /// the diagonal; touching: other corners may lie on the diagonal; flat: degenerate triangles may be clipped, too.
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

  std::vector<Point> points_;  ///< corners of the polygon; only the coordinates u_ and v_ are used
  int drop_ = 2, sign_ = 1, u_ = 0, v_ = 1;
  std::vector<uint32_t> next_, previous_, queue_, waiting_first_;
  /// place_: for each corner, its leaf node in the k-d tree; corner_in_: for each leaf, its corner
  std::vector<uint32_t> order_, place_, corner_in_;
  std::vector<Waiting> waiting_;
  std::vector<bool> queued_, gone_;
  std::vector<Box> boxes_;
  std::vector<uint32_t> stack_;
  size_t leaves_ = 0, left_ = 0;
  uint64_t steps_ = 0, max_steps_;
};

}  // namespace sgm::asset
