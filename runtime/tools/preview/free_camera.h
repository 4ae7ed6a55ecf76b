#pragma once
// A camera that a mouse and keys move.

#include <array>
#include <glm/vec3.hpp>

namespace sgm::preview {

/// Looks from a place to a target, never upside down. Lengths are metres of the world, angles radians. In a hollow the
/// place stays while the camera turns; from outside the camera goes round its target.
class FreeCamera {
 public:
  using Gaze = std::array<std::array<double, 3>, 2>;  ///< from where and to where

  /// Contract: the two points differ. inside: the camera stands in a hollow.
  FreeCamera(const Gaze& gaze, bool inside);

  Gaze gaze() const;
  bool isInside() const { return inside_; }

  /// To the right and up, as the mouse drags the picture.
  void turn(double right, double up);
  /// Camera and target by so many metres along the picture's axes.
  void move(double right, double up, double forward);
  /// Nearer to the target by a factor above 0; in a hollow forward by the share of the distance that goes.
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

/// The direction, of any length, in which a camera with square pixels sees a place of its picture: x and y are 0..1
/// from the top left corner, fov is the angle across the picture's height, aspect its width by its height. Contract:
/// the gaze's two points differ.
glm::dvec3 rayThrough(const FreeCamera::Gaze& gaze, double fov, double aspect, double x, double y);

}  // namespace sgm::preview
