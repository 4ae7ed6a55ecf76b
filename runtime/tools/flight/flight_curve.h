#pragma once
// A smooth curve through given places, parametrized by arc length.

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sgm::cli {

using Metres3 = glm::dvec3;

/// Position of a flight, in metres, and its direction, of length one.
struct FlightPlace {
  Metres3 position{0};
  Metres3 direction{0, 0, -1};
};

/// The Catmull-Rom spline through the control points, with their distances as parameter intervals, sampled at points
/// that are at most about `spacing` apart and include the first and last control point. If `start` is given and not
/// zero, the curve begins in that direction. If closed, it returns to its first control point. Precondition: at least
/// two control points; neighbours differ.
std::vector<Metres3> splinePoints(std::span<const Metres3> controls, double spacing, bool closed,
                                  const std::optional<Metres3>& start = {});

/// A curve of evenly spaced places, to which points can be appended.
class FlightCurve {
 public:
  explicit FlightCurve(double spacing) : spacing_(spacing) {}

  /// Appends these points. The first point must be the curve's end, unless the curve is empty.
  void extend(std::span<const Metres3> points);
  /// The maximum of s in at(): the arc length up to the last point, or up to one spacing less.
  double length() const { return places_.empty() ? 0 : spacing_ * static_cast<double>(places_.size() - 1); }
  /// The place at arc length s, which is clamped to 0..length(). Precondition: the curve is not empty.
  FlightPlace at(double s) const;

 private:
  double spacing_;
  std::vector<Metres3> places_;
  Metres3 end_{0};        ///< last appended point
  double to_next_ = 0.0;  ///< arc length from end_ to the next evenly spaced place
};

}  // namespace sgm::cli
