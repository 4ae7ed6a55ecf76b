#pragma once
// Along and around a bent tube.

#include <span>
#include <vector>

#include "base/fixed.h"
#include "derive/frame.h"

namespace sgm {

/// A line with a frame that is carried along without twist (framesAlong), and starts with the world's +y up.
class SweepLine {
 public:
  /// At least two points, no two neighbours the same.
  explicit SweepLine(std::span<const Int3> points);

  struct Place {
    double along = 0;  ///< units from the first point; below 0 before it, more than the line has behind the last
    double turn = 0;   ///< -pi to pi: 0 on the upper side, positive towards tangent x up
    Vec3 outward;      ///< from the line to the point, any length
  };
  /// By the nearest segment, of several the first. p: relative to the first point, units.
  Place at(Vec3 p) const;

 private:
  struct Segment {
    Vec3 from, tangent, up, side;
    double length = 0, before = 0;
  };
  std::vector<Segment> segments_;
  double length_ = 0;
};

}  // namespace sgm
