#pragma once
// A camera moved by mouse and keys.

#include <array>
#include <glm/vec3.hpp>

namespace sgm::preview {

/// Looks from a place to a target, never upside down. Lengths are metres of the world, angles radians. In a hollow, the
/// camera turns in place; outside, it orbits its target.
class FreeCamera {
 public:
  using Gaze = std::array<std::array<double, 3>, 2>;  ///< position and target

  /// Contract: the two points differ. inside: the camera is in a hollow.
  FreeCamera(const Gaze& gaze, bool inside);

  Gaze gaze() const;
  bool isInside() const { return inside_; }

  /// To the right and up, in the direction of a mouse drag.
  void turn(double right, double up);
  /// Moves camera and target along the picture's axes, in metres.
  void move(double right, double up, double forward);
  /// Changes the distance to the target by a factor above 0; in a hollow, moves forward by the same length.
  void approach(double factor);

  double distance() const { return distance_; }

 private:
  glm::dvec3 forward() const;

  bool inside_;
  glm::dvec3 target_{0};
  double distance_ = 1;
  double heading_ = 0;  ///< about y, 0 along -z
  double pitch_ = 0;    ///< above the horizon
};

/// The direction, of any length, of the ray through a place of the picture of a camera with square pixels: x and y are
/// 0..1 from the top left corner, fov is the angle across the picture's height, aspect is width by height. Contract:
/// the gaze's two points differ.
glm::dvec3 rayThrough(const FreeCamera::Gaze& gaze, double fov, double aspect, double x, double y);

}  // namespace sgm::preview
