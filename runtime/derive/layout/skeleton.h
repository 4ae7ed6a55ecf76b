#pragma once
// Branching skeletons: the path of a turtle that turns at random and leaves side branches. These are Lindenmayer's
// bracketed, stochastic systems (Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants, 1990, sections 1.6
// and 1.7). Random draws depend on the position in the tree instead of the order of drawing, so that no part depends on
// the growth of the rest.

#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "derive/frame.h"

namespace sgm {

/// One step of the turtle. The next step, and a side branch that starts there, begin exactly at `to`, bit for bit.
struct Segment {
  Vec3 from, to;
  /// distance from the root to `from`, as a fraction of the longest path: 0 at the root, 1 at the tips
  double along = 0;
  uint32_t depth = 0;  ///< 0 on the stem, 1 on its side branches, 2 on the side branches of side branches, and so on
  PathKey key;         ///< key for random draws; depends only on the segment's branch and its index in the branch
};

struct Turtle {
  /// number of steps of the longest path from the root to a tip; a whole number, at most kMaxSegments
  double steps = 0;
  double length = 0;  ///< length of a step, metres, above 0
  double turn = 0;    ///< maximum turn between steps, radians; 0 to a right angle
  double fork = 0;    ///< probability of a side branch after a step, 0 to 1
};

struct Skeleton {
  /// all segments: the stem first, then branches in order of depth, each after the branch from which it starts
  std::vector<Segment> segments;
  bool whole = true;  ///< false: some branches are missing because there would be more than kMaxSegments segments
};

/// The turtle starts at the origin, facing +y. Its first step is straight; each further step turns to a direction drawn
/// uniformly from the cone with half-angle `turn` around the previous step. After each step except the last, with
/// probability `fork`, a side branch starts and takes the remaining steps. Its angle to the previous step is drawn from
/// turn to 2 turn (at most a right angle), on the side opposite to the continuing branch, so that the side branch is at
/// least `turn` away from the previous step and from the continuing branch. If `turn` is 0 there are no side branches,
/// since they would coincide with the continuing branch.
///
/// Each draw hashes `key`, the side branches on the path from the root, and the step. Therefore a smaller `fork` only
/// removes branches, fewer steps only shorten them, and everything else stays in place; `length` and `turn` change no
/// draw.
Skeleton grownSkeleton(PathKey key, const Turtle& turtle);

}  // namespace sgm
