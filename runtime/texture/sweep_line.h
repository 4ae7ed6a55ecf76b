#pragma once
// Coordinates along and around a bent tube (a sweep along a polyline).

#include <span>
#include <vector>

#include "base/fixed.h"
#include "derive/frame.h"

namespace sgm {

/// The position of a point relative to a polyline.
struct SweepPlace {
  /// arc length along the line in units (1/1024 m); negative before its start, above length() beyond its end
  double along = 0;
  double side = 0, up = 0;  ///< signed distances from the line in units: towards cross(tangent, up), and towards up
  Vec3 outward;             ///< vector from the line to the point, of any length
  Vec3 tangent;             ///< direction of the nearest segment, of length 1
};

/// A polyline with a rotation-minimising frame along it (framesAlong).
class SweepLine {
 public:
  /// points: at least two, consecutive points distinct. up: the frame's up vector at the first point.
  explicit SweepLine(std::span<const Int3> points, Vec3 up = {0, 1, 0});

  double length() const { return length_; }
  /// Returns the position of a point relative to the nearest segment; if several are equally near, the first one. p:
  /// relative to the first point of the line, in units (1/1024 m).
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
