#pragma once
// Coordinates along and around a bent tube (a sweep).

#include <span>
#include <vector>

#include "base/fixed.h"
#include "derive/frame.h"

namespace sgm {

/// The position of a point relative to a line.
struct SweepPlace {
  /// units along the line from its first point; negative before it, more than length() beyond the last
  double along = 0;
  double side = 0, up = 0;  ///< distances across the line in units: towards cross(tangent, up), and towards up
  Vec3 outward;             ///< from the line to the point; any length
  Vec3 tangent;             ///< direction of the line, of length 1
};

/// A polyline with a frame that is transported without twist (framesAlong).
class SweepLine {
 public:
  /// points: at least two, consecutive ones distinct. up: the up vector at the first point.
  explicit SweepLine(std::span<const Int3> points, Vec3 up = {0, 1, 0});

  double length() const { return length_; }
  /// Returns the position relative to the nearest segment; of several, the first. p: relative to the first point, in
  /// units.
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
