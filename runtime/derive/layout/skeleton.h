#pragma once
// Branching skeletons: the path of a turtle that turns at random and leaves side branches. Lindenmayer's bracketed,
// stochastic systems (Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants, 1990, sections 1.6 and 1.7),
// with draws by position in the tree instead of in order, so that no part depends on the growth of the rest.

#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "derive/frame.h"

namespace sgm {

/// One step of the turtle. The next step and a side branch begin at `to`, bit for bit.
struct Segment {
  Vec3 from, to;
  double along = 0;    ///< steps from the root to `from` as a fraction of `steps`: 0 at the root, 1 at the tips
  uint32_t depth = 0;  ///< 0 on the stem, 1 on its side branches, 2 on their side branches
  PathKey key;         ///< depends only on its branch and its number on it
};

struct Turtle {
  double steps = 0;   ///< of the longest path from the root to a tip; a whole number, at most kMostSegments
  double length = 0;  ///< of a step, positive
  double turn = 0;    ///< radians, 0 to a right angle
  double fork = 0;    ///< probability, 0 to 1
};

struct Skeleton {
  std::vector<Segment> segments;  ///< the stem, then branches by depth, each after the one it leaves
  bool whole = true;              ///< false if branches are left out that would exceed kMostSegments
};

/// The turtle starts at the origin and faces +y. Its first step is straight; each further one turns by a direction
/// drawn uniformly from the cone of half-angle `turn` around the previous step. After each step but the last, with
/// probability `fork`, a side branch starts and takes the remaining steps: at an angle drawn from turn to 2 turn (at
/// most a right angle) to the previous step, and on the opposite side of the continuing branch, so that it is at least
/// `turn` away from both. If `turn` is 0 it would coincide with that branch, so there are no side branches.
///
/// Draws hash `key`, the side branches on the path from the root, and the step. So a smaller `fork` leaves branches
/// out, and fewer steps cut them short, and the rest stays in place; `length` and `turn` change no draw.
Skeleton grownSkeleton(PathKey key, const Turtle& turtle);

}  // namespace sgm
