#pragma once
// A bounding volume hierarchy over triangles, to find pairs that may intersect.

#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/jobs.h"
#include "base/large_pages.h"
#include "measure/triangles.h"

namespace sgm::measure {

/// A complete binary tree over the triangles in Morton order, one per leaf. Node n has the children 2 n and 2 n + 1;
/// node 1 is the root.
class Bvh {
 public:
  /// A box in single precision, rounded outwards. An empty box overlaps no other box.
  struct Box {
    float low[3], high[3];

    /// Combines the comparisons without branches, because their results are unpredictable.
    bool overlaps(const Box& other) const {
      int all = 1;
      for (int axis = 0; axis < 3; ++axis) {
        all &= static_cast<int>(low[axis] <= other.high[axis]) & static_cast<int>(other.low[axis] <= high[axis]);
      }
      return all != 0;
    }
  };

  /// Precondition: the coordinates are at most kFarthest. Takes at most 120 bytes per triangle.
  Bvh(const Triangles& mesh, JobSystem& jobs);

  size_t leaves() const { return boxes_.size() / 2; }
  const Box& box(size_t node) const { return boxes_[node]; }
  bool isLeaf(size_t node) const { return node >= leaves(); }
  /// Returns the triangle of a leaf. Leaves at the end of the last row may have no triangle; their boxes overlap no
  /// other box.
  uint32_t triangle(size_t leaf) const { return order_[leaf - leaves()]; }

  /// Two nodes whose leaves may overlap each other. If both are the same node, its leaves may overlap among themselves.
  using Pair = std::pair<uint32_t, uint32_t>;
  /// Splits the search for several threads: every pair of leaves with overlapping boxes belongs to exactly one of the
  /// returned pairs of nodes. Returns at least about `parts` pairs, if that many exist.
  std::vector<Pair> parts(size_t parts) const;

  /// The state of a walk that visits the pairs of leaves below a pair of nodes. With this state, an interrupted walk
  /// can be resumed.
  struct Walk {
    // Capacity: each row of the tree adds at most three waiting pairs.
    std::array<Pair, 3 * 32 + 4> waiting;
    size_t count = 0;

    explicit Walk(Pair pair) : waiting{pair}, count(1) {}
    bool ended() const { return count == 0; }
  };

  /// Calls visit(a, b) with the triangles of each pair of leaves of the walk whose boxes overlap. visit may return a
  /// number of additional steps. A call counts as one step plus these; each visit of a pair of inner nodes counts as
  /// one step. Stops after `max_steps` steps; returns the number of steps taken.
  template <class Visit>
  uint64_t visitPairs(Walk& walk, uint64_t max_steps, Visit&& visit) const {
    uint64_t steps = 0;
    for (; walk.count > 0 && steps < max_steps; ++steps) {
      const auto [a, b] = walk.waiting[--walk.count];
      if (a != b && isLeaf(a)) {
        if constexpr (std::is_void_v<std::invoke_result_t<Visit&, uint32_t, uint32_t>>) {
          visit(triangle(a), triangle(b));
        } else {
          steps += visit(triangle(a), triangle(b));
        }
      } else {
        walk.count += split({a, b}, &walk.waiting[walk.count]);
      }
    }
    return steps;
  }

  /// A ray along an axis, towards higher or lower coordinates. The ray includes the point at which it starts.
  struct Column {
    int axis = 2;
    bool above = true;
  };

  /// Calls visit(triangle) for each triangle whose box meets the ray from `at`. Returns false if it stopped because it
  /// had visited `max_steps` nodes.
  template <class Visit>
  bool visitColumn(Point at, Column column, uint64_t max_steps, Visit&& visit) const {
    // Capacity: each row of the tree adds at most one waiting node.
    std::array<uint32_t, 34> waiting;
    waiting[0] = 1;
    size_t count = 1;
    for (uint64_t steps = 0; count > 0; ++steps) {
      if (steps == max_steps) return false;
      const uint32_t node = waiting[--count];
      const Box& box = boxes_[node];
      const auto reaches = [&](int axis) {
        return static_cast<double>(box.low[axis]) <= at[axis] && at[axis] <= static_cast<double>(box.high[axis]);
      };
      const bool passed = column.above ? static_cast<double>(box.high[column.axis]) < at[column.axis]
                                       : static_cast<double>(box.low[column.axis]) > at[column.axis];
      if (!reaches((column.axis + 1) % 3) || !reaches((column.axis + 2) % 3) || passed) continue;
      if (isLeaf(node)) {
        visit(triangle(node));
      } else {
        waiting[count++] = 2 * node;
        waiting[count++] = 2 * node + 1;
      }
    }
    return true;
  }

 private:
  /// Splits a pair of nodes: writes the pairs of their children whose boxes overlap to `into`, which has space for four
  /// pairs, and returns the number of these pairs.
  size_t split(Pair pair, Pair* into) const {
    const auto [a, b] = pair;
    size_t count = 0;
    const auto push = [&](uint32_t first, uint32_t second) {
      into[count] = {first, second};
      count += static_cast<size_t>(boxes_[first].overlaps(boxes_[second]));
    };
    if (a == b) {
      if (isLeaf(a)) return 0;
      push(2 * a, 2 * a);
      push(2 * a + 1, 2 * a + 1);
      push(2 * a, 2 * a + 1);
      return count;
    }
    // Both nodes are in the same row of the tree, so both have children.
    push(2 * a, 2 * b);
    push(2 * a, 2 * b + 1);
    push(2 * a + 1, 2 * b);
    push(2 * a + 1, 2 * b + 1);
    return count;
  }

  LargeVector<Box> boxes_;
  LargeVector<uint32_t> order_;
};

}  // namespace sgm::measure
