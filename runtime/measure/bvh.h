#pragma once
// A tree of boxes over triangles, to find those that may meet.

#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/jobs.h"
#include "base/large_pages.h"
#include "measure/triangles.h"

namespace sgm::measure {

/// A complete binary tree over the triangles in the order of a space-filling curve (Morton), one a leaf. Node n has the
/// children 2 n and 2 n + 1; node 1 is the root.
class Bvh {
 public:
  /// In single precision, rounded outwards. One around nothing overlaps none.
  struct Box {
    float low[3], high[3];

    /// Without a branch: which comparison fails is anyone's guess.
    bool overlaps(const Box& other) const {
      int all = 1;
      for (int axis = 0; axis < 3; ++axis) {
        all &= static_cast<int>(low[axis] <= other.high[axis]) & static_cast<int>(other.low[axis] <= high[axis]);
      }
      return all != 0;
    }
  };

  /// Contract: the coordinates are at most kFarthest. At most 120 bytes a triangle.
  Bvh(const Triangles& mesh, JobSystem& jobs);

  size_t leaves() const { return boxes_.size() / 2; }
  const Box& box(size_t node) const { return boxes_[node]; }
  bool isLeaf(size_t node) const { return node >= leaves(); }
  /// Of a leaf that has one: those at the end of the last row may have none, and their boxes overlap nothing.
  uint32_t triangle(size_t leaf) const { return order_[leaf - leaves()]; }

  /// Two nodes whose leaves may meet each other; the same one twice: whose leaves may meet among themselves.
  using Pair = std::pair<uint32_t, uint32_t>;
  /// Pairs that hold all pairs of leaves whose boxes overlap, each in one of them, at least about `parts` where there
  /// are as many: what several threads then walk.
  std::vector<Pair> parts(size_t parts) const;

  /// Where a walk over the leaves under a pair stands: it goes on where it stopped.
  struct Walk {
    // Each row of the tree leaves three pairs at most behind.
    std::array<Pair, 3 * 32 + 4> waiting;
    size_t count = 0;

    explicit Walk(Pair pair) : waiting{pair}, count(1) {}
    bool ended() const { return count == 0; }
  };

  /// Calls visit(a, b) with the triangles of each two leaves of the walk whose boxes overlap, and stops after so many
  /// steps: a call, with those that it returns besides, or a look at two nodes. Returns how many it took.
  template <class Visit>
  uint64_t visitPairs(Walk& walk, uint64_t most_steps, Visit&& visit) const {
    uint64_t steps = 0;
    for (; walk.count > 0 && steps < most_steps; ++steps) {
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

  /// The part of the line through a place along an axis, the place included: towards higher coordinates, or lower ones.
  struct Column {
    int axis = 2;
    bool above = true;
  };

  /// Calls visit(triangle) for each whose box meets that part of the place's line. Returns whether it came to the end
  /// within so many steps, each a look at a node.
  template <class Visit>
  bool visitColumn(Point at, Column column, uint64_t most_steps, Visit&& visit) const {
    // Each row of the tree leaves one node at most behind.
    std::array<uint32_t, 34> waiting;
    waiting[0] = 1;
    size_t count = 1;
    for (uint64_t steps = 0; count > 0; ++steps) {
      if (steps == most_steps) return false;
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
  /// Writes the pairs of children that overlap, four at most, and returns how many they are. into: room for four.
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
    // Both stand in one row of the tree.
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
