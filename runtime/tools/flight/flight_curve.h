#pragma once
// A smooth curve through given points, parametrized by arc length.

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sgm::cli {

using Metres3 = glm::dvec3;

/// Position on a flight path, in metres, and the unit direction of flight.
struct FlightPlace {
  Metres3 position{0};
  Metres3 direction{0, 0, -1};
};

/// Samples the Catmull-Rom spline through the control points; the distances between them are the parameter intervals.
/// The samples are at most about `spacing` apart and include the first and last control point. If `start` is given and
/// not zero, the curve begins in that direction. If `closed`, the curve returns to its first control point.
/// Precondition: at least two control points; neighbouring points differ.
std::vector<Metres3> splinePoints(std::span<const Metres3> controls, double spacing, bool closed,
                                  const std::optional<Metres3>& start = {});

/// A curve that is resampled at even spacing, and to which points can be appended.
class FlightCurve {
 public:
  explicit FlightCurve(double spacing) : spacing_(spacing) {}

  /// Appends points to the curve. The first point must be the current end of the curve, unless the curve is empty.
  void extend(std::span<const Metres3> points);
  /// The maximum of s in at(): the arc length up to the last resampled place. It is at most one spacing shorter than
  /// the whole curve.
  double length() const { return places_.empty() ? 0 : spacing_ * static_cast<double>(places_.size() - 1); }
  /// The place at arc length s, which is clamped to 0..length(). Precondition: the curve is not empty.
  FlightPlace at(double s) const;

 private:
  double spacing_;
  std::vector<Metres3> places_;
  Metres3 end_{0};        ///< the last point that was appended
  double to_next_ = 0.0;  ///< arc length from end_ to the next evenly spaced place
};

}  // namespace sgm::cli
