#pragma once
// A camera that the mouse and keys move.

#include <array>
#include <glm/vec3.hpp>

namespace sgm::preview {

/// Looks from a position to a target and is never upside down. Lengths are metres of the world, angles are radians. In
/// a hollow, the camera turns in place; outside, it orbits its target.
class FreeCamera {
 public:
  using Gaze = std::array<std::array<double, 3>, 2>;  ///< position and target

  /// Contract: position and target differ. inside: the camera is in a hollow.
  FreeCamera(const Gaze& gaze, bool inside);

  Gaze gaze() const;
  bool isInside() const { return inside_; }

  /// Turns by angles to the right and up, for a mouse drag in that direction.
  void turn(double right, double up);
  /// Moves position and target along the axes of the picture, in metres.
  void move(double right, double up, double forward);
  /// Multiplies the distance to the target by a factor above 0. In a hollow, moves forward by the same length instead.
  void approach(double factor);

  double distance() const { return distance_; }

 private:
  glm::dvec3 forward() const;

  bool inside_;
  glm::dvec3 target_{0};
  double distance_ = 1;
  double heading_ = 0;  ///< angle about the y axis, 0 along -z
  double pitch_ = 0;    ///< angle above the horizon
};

/// The direction, of any length, of the ray through a point of the picture, for a camera with square pixels. x and y
/// are 0..1 from the top left corner, fov is the angle across the picture's height in radians, aspect is width divided
/// by height. Contract: the gaze's two points differ.
glm::dvec3 rayThrough(const FreeCamera::Gaze& gaze, double fov, double aspect, double x, double y);

}  // namespace sgm::preview
