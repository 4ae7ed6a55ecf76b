#pragma once
// A camera that the mouse and the keyboard move.

#include <array>
#include <glm/vec3.hpp>

namespace sgm::preview {

/// A camera that looks from a position at a target and is never upside down. Lengths are in metres of the world, angles
/// in radians. Inside a hollow, the camera turns in place; outside, it orbits its target.
class FreeCamera {
 public:
  using Gaze = std::array<std::array<double, 3>, 2>;  ///< position and target

  /// Contract: position and target differ. inside: the camera is in a hollow.
  FreeCamera(const Gaze& gaze, bool inside);

  Gaze gaze() const;
  bool isInside() const { return inside_; }

  /// Turns the camera for a mouse drag by the given angles to the right and up.
  void turn(double right, double up);
  /// Moves position and target along the right, up and forward axes of the picture, in metres.
  void move(double right, double up, double forward);
  /// Multiplies the distance to the target by a factor above 0. Inside a hollow, moves camera and target forward
  /// instead, by the amount by which the distance would decrease.
  void approach(double factor);

  double distance() const { return distance_; }

 private:
  glm::dvec3 forward() const;

  bool inside_;
  glm::dvec3 target_{0};
  double distance_ = 1;
  double heading_ = 0;  ///< angle about the y axis; 0 looks along -z
  double pitch_ = 0;    ///< angle above the horizon
};

/// The direction (not normalized) of the ray through a point of the picture. x and y: point in the picture, 0..1 from
/// the top left corner. fov: vertical field of view, radians. aspect: width divided by height. Contract: the two points
/// of the gaze differ.
glm::dvec3 rayThrough(const FreeCamera::Gaze& gaze, double fov, double aspect, double x, double y);

}  // namespace sgm::preview
