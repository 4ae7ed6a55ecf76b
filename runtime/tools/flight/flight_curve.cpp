#include "tools/flight/flight_curve.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sgm::cli {

namespace {

/// The vector scaled to length one; a zero vector is returned unchanged.
Metres3 unit(const Metres3& a) {
  const double length = glm::length(a);
  return length > 0 ? a / length : a;
}

}  // namespace

std::vector<Metres3> splinePoints(std::span<const Metres3> controls, double spacing, bool closed,
                                  const std::optional<Metres3>& start) {
  const size_t count = controls.size(), segments = closed ? count : count - 1;
  const auto control = [&](size_t i) { return controls[i % count]; };
  // Velocity at a control point for unit speed: the weighted mean of the slopes of the chords on both sides. The slope
  // towards the nearer neighbour has more weight.
  const auto velocity = [&](size_t i) {
    const bool first = i == 0 && !closed, last = i == count - 1 && !closed;
    if (first && start) return unit(*start);
    const Metres3 before = control(i + count - 1), here = control(i), after = control(i + 1);
    if (first) return unit(after - here);
    if (last) return unit(here - before);
    const double left = glm::length(here - before), right = glm::length(after - here);
    return 1 / (left + right) * (right / left * (here - before) + left / right * (after - here));
  };
  std::vector<Metres3> points{controls[0]};
  for (size_t i = 0; i < segments; ++i) {
    const Metres3 a = control(i), b = control(i + 1);
    const double length = glm::length(b - a);
    const Metres3 va = length * velocity(i), vb = length * velocity((i + 1) % count);
    // A spline segment is at most about 1.5 times as long as its chord, so enough samples for twice the chord suffice.
    const auto steps = static_cast<size_t>(std::ceil(2 * length / spacing));
    for (size_t step = 1; step <= steps; ++step) {
      const double t = static_cast<double>(step) / static_cast<double>(steps), u = 1 - t;
      points.push_back((u * u * (1 + 2 * t)) * a + (u * u * t) * va + (t * t * (3 - 2 * t)) * b + (-t * t * u) * vb);
    }
    points.back() = b;
  }
  return points;
}

void FlightCurve::extend(std::span<const Metres3> points) {
  if (points.empty()) return;
  if (places_.empty()) {
    places_.push_back(points[0]);
    to_next_ = spacing_;
    end_ = points[0];
  }
  for (const Metres3& to : points) {
    Metres3 from = end_;
    double left = glm::length(to - from);
    while (left >= to_next_ && left > 0) {
      from = from + to_next_ / left * (to - from);
      left -= to_next_;
      places_.push_back(from);
      to_next_ = spacing_;
    }
    to_next_ -= left;
    end_ = to;
  }
}

FlightPlace FlightCurve::at(double s) const {
  const double along = std::clamp(s, 0.0, length()) / spacing_;
  const size_t last = places_.size() - 1, i = std::min(static_cast<size_t>(along), last);
  const size_t next = std::min(i + 1, last);
  const auto slope = [&](size_t at) { return places_[std::min(at + 1, last)] - places_[at == 0 ? 0 : at - 1]; };
  FlightPlace place;
  const double t = along - static_cast<double>(i);
  place.position = places_[i] + t * (places_[next] - places_[i]);
  const Metres3 direction = unit((1 - t) * slope(i) + t * slope(next));
  // Where the curve reverses its direction, the interpolated direction is zero: keep the default direction.
  if (glm::length(direction) > 0) place.direction = direction;
  return place;
}

}  // namespace sgm::cli
