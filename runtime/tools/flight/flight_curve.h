#pragma once
// A smooth curve through places, by arc length.

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sgm::cli {

using Metres3 = glm::dvec3;

/// Where a flight is, in metres, and the way it goes, of length one.
struct FlightPlace {
  Metres3 position{0};
  Metres3 direction{0, 0, -1};
};

/// The Catmull-Rom spline through the controls, by their distances: points about `spacing` apart or nearer, the first
/// and the last control among them. It begins in direction `start`, where that is given and not zero. A closed one
/// comes back to its first control. Precondition: two controls or more; neighbours differ.
std::vector<Metres3> splinePoints(std::span<const Metres3> controls, double spacing, bool closed,
                                  const std::optional<Metres3>& start = {});

/// Places an even distance apart along a curve that can be made longer.
class FlightCurve {
 public:
  explicit FlightCurve(double spacing) : spacing_(spacing) {}

  /// Goes on through these points; the first one is where the curve ended, if it has begun.
  void extend(std::span<const Metres3> points);
  /// How far at() can be asked: up to the last point, or a spacing less.
  double length() const { return places_.empty() ? 0 : spacing_ * static_cast<double>(places_.size() - 1); }
  /// Precondition: the curve has begun. s is held to 0..length().
  FlightPlace at(double s) const;

 private:
  double spacing_;
  std::vector<Metres3> places_;
  Metres3 end_{0};        ///< of what came so far
  double to_next_ = 0.0;  ///< along the curve from end_ to the next place
};

}  // namespace sgm::cli
