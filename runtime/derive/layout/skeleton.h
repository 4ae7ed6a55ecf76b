#pragma once
// Branching skeletons: what a turtle walks that turns at random and leaves side branches behind it. Lindenmayer's
// bracketed, stochastic systems (Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants, 1990, sections 1.6
// and 1.7), drawn by place in the tree instead of in order, so that no part of it depends on how the rest grows.

#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "derive/frame.h"

namespace sgm {

/// One step of the turtle. Where the next begins, and where a side branch begins, is `to`, bit for bit.
struct Segment {
  Vec3 from, to;
  double along = 0;    ///< steps from the root to `from`, as a share of `steps`: 0 at the root, 1 where the tips end
  uint32_t depth = 0;  ///< 0 on the stem, 1 on its side branches, 2 on theirs
  PathKey key;         ///< of its branch and its number on it alone
};

struct Turtle {
  double steps = 0;   ///< of the longest way from the root to a tip; a whole number, at most kMostSegments
  double length = 0;  ///< of a step, positive
  double turn = 0;    ///< radians, 0 to a right angle
  double fork = 0;    ///< probability, 0 to 1
};

struct Skeleton {
  std::vector<Segment> segments;  ///< the stem, then branch by branch, each behind the one it leaves, least depth first
  bool whole = true;              ///< otherwise branches are left out that would have passed kMostSegments
};

/// The turtle starts at the origin and looks along +y. Its first step goes straight; each further one turns by a
/// direction drawn evenly from the cone of half-angle `turn` about the step before. After each step but the last, with
/// probability `fork`, a side branch starts, and takes the steps that remain: at an angle drawn from turn to 2 turn (at
/// most a right angle) to the step before it, and to the other side than the branch it leaves goes on, so that it is at
/// least `turn` away from both. Without a turn it would lie on that branch, and there is none.
///
/// Draws hash `key`, the side branches on the way from the root, and the step. So a smaller `fork` leaves branches out,
/// and fewer steps cut them short, and what is left stays where it was; `length` and `turn` change no draw.
Skeleton grownSkeleton(PathKey key, const Turtle& turtle);

}  // namespace sgm
