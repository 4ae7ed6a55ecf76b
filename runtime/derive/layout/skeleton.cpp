#include "derive/layout/skeleton.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "derive/draws.h"
#include "grammar/syntax/builtins.h"

namespace sgm {
namespace {

/// A branch that has not been grown yet.
struct Bud {
  Vec3 at, heading;
  uint32_t first = 0;  ///< number of steps from the root to the start of the branch
  uint32_t depth = 0;
  PathKey key;
};

/// Returns a heading rotated away from `heading`. cosine: cosine of the angle between both; around: angle about the old
/// heading that selects the direction in which the new heading deviates.
Vec3 turned(Vec3 heading, double cosine, double around) {
  const Vec3 side = across(heading, {0, 1, 0}), other = cross(heading, side);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return normalised(cosine * heading + sine * (detCos(around) * side + detSin(around) * other));
}

}  // namespace

Skeleton grownSkeleton(PathKey key, const Turtle& turtle) {
  Skeleton out;
  const uint32_t steps = static_cast<uint32_t>(turtle.steps);
  const double straightest = detCos(turtle.turn);
  std::vector<Bud> buds{{{}, {0, 1, 0}, 0, 0, key}};
  // Branches are grown in order of depth, so that if there are too many, the finest twigs are left out.
  for (size_t b = 0; b < buds.size(); ++b) {
    const Bud bud = buds[b];
    if (steps - bud.first > kMaxSegments - out.segments.size()) {
      out.whole = false;
      continue;
    }
    Vec3 at = bud.at, heading = bud.heading;
    for (uint32_t i = bud.first; i < steps; ++i) {
      const Vec3 to = at + turtle.length * heading;
      out.segments.push_back({at, to, i / turtle.steps, bud.depth, bud.key.child(kSegmentSalt, i)});
      at = to;
      const PathKey joint = bud.key.child(kJointSalt, i);
      // A uniform cosine gives a uniform direction on the sphere (Archimedes).
      const double cosine = 1.0 - (1.0 - straightest) * joint.unit(kTurnDraw);
      const double around = 2 * kPi * joint.unit(kAroundDraw);
      if (i + 1 < steps && turtle.turn > 0 && joint.unit(kForkDraw) < turtle.fork) {
        const double leave = std::min(turtle.turn * (1.0 + joint.unit(kLeaveDraw)), kPi / 2);
        const double opposite = around + kPi * (0.5 + joint.unit(kSideDraw));
        buds.push_back(
            {at, turned(heading, detCos(leave), opposite), i + 1, bud.depth + 1, bud.key.child(kForkSalt, i)});
      }
      heading = turned(heading, cosine, around);
    }
  }
  return out;
}

}  // namespace sgm
