#pragma once
// Coordinates along and around a bent tube.

#include <span>
#include <vector>

#include "base/fixed.h"
#include "derive/frame.h"

namespace sgm {

/// The position of a point relative to a line.
struct SweepPlace {
  double along = 0;         ///< units from the first point; negative before it, more than length() after the last
  double side = 0, up = 0;  ///< across the line, units: towards tangent x up, and towards up
  Vec3 outward;             ///< from the line to the point, any length
  Vec3 tangent;             ///< of length 1
};

/// A polyline with a frame that is transported without twist (framesAlong).
class SweepLine {
 public:
  /// points: at least two, consecutive ones distinct; up: the up vector at the start.
  explicit SweepLine(std::span<const Int3> points, Vec3 up = {0, 1, 0});

  double length() const { return length_; }
  /// Uses the nearest segment, the first if several are. p: relative to the first point, units.
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
