#pragma once
// Along and around a bent tube.

#include <span>
#include <vector>

#include "base/fixed.h"
#include "derive/frame.h"

namespace sgm {

/// Where a point lies by a line.
struct SweepPlace {
  double along = 0;         ///< units from the first point; below 0 before it, more than length() behind the last
  double side = 0, up = 0;  ///< across the line, units: towards tangent x up, and towards up
  Vec3 outward;             ///< from the line to the point, any length
  Vec3 tangent;             ///< of length 1
};

/// A line with a frame that is carried along without twist (framesAlong).
class SweepLine {
 public:
  /// At least two points, no two neighbours the same; up: where the frame starts.
  explicit SweepLine(std::span<const Int3> points, Vec3 up = {0, 1, 0});

  double length() const { return length_; }
  /// By the nearest segment, of several the first. p: relative to the first point, units.
  SweepPlace at(Vec3 p) const;

 private:
  struct Segment {
    Vec3 from, tangent, up, side;
    double length = 0, before = 0;
  };
  std::vector<Segment> segments_;
  double length_ = 0;
};

}  // namespace sgm
