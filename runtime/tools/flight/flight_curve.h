#pragma once
// A smooth curve through places, by arc length.

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

/// The Catmull-Rom spline through the controls, parametrized by their distances, as points about `spacing` apart or
/// nearer, which include the first and last control. It begins in direction `start`, if given and not zero. If closed,
/// it returns to its first control. Precondition: at least two controls; neighbours differ.
std::vector<Metres3> splinePoints(std::span<const Metres3> controls, double spacing, bool closed,
                                  const std::optional<Metres3>& start = {});

/// Evenly spaced places along a curve that can be extended.
class FlightCurve {
 public:
  explicit FlightCurve(double spacing) : spacing_(spacing) {}

  /// Appends these points; the first must be the curve's end, unless the curve is empty.
  void extend(std::span<const Metres3> points);
  /// The upper limit of s in at(): the arc length to the last point, or up to a spacing less.
  double length() const { return places_.empty() ? 0 : spacing_ * static_cast<double>(places_.size() - 1); }
  /// Precondition: the curve is not empty. s is clamped to 0..length().
  FlightPlace at(double s) const;

 private:
  double spacing_;
  std::vector<Metres3> places_;
  Metres3 end_{0};        ///< last point so far
  double to_next_ = 0.0;  ///< along the curve from end_ to the next place
};

}  // namespace sgm::cli
