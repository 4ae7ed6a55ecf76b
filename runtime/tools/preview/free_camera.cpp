#include "tools/preview/free_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sgm::preview {
namespace {

constexpr double kSteepest = 1.55;  // maximum pitch in radians; straight up, the heading would be undefined
constexpr double kNearest = 0.01;   // minimum distance to the target, metres

glm::dvec3 pointOf(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }
std::array<double, 3> arrayOf(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

/// The horizontal unit vector to the right of the direction `forward`.
glm::dvec3 rightOf(const glm::dvec3& forward) {
  const glm::dvec3 right = glm::cross(forward, glm::dvec3(0, 1, 0));
  const double length = glm::length(right);
  return length > 1e-12 ? right / length : glm::dvec3(1, 0, 0);
}

}  // namespace

FreeCamera::FreeCamera(const Gaze& gaze, bool inside) : inside_(inside), target_(pointOf(gaze[1])) {
  const glm::dvec3 along = target_ - pointOf(gaze[0]);
  distance_ = std::max(glm::length(along), kNearest);
  heading_ = std::atan2(along.x, -along.z);
  pitch_ = std::clamp(std::asin(std::clamp(along.y / distance_, -1.0, 1.0)), -kSteepest, kSteepest);
}

glm::dvec3 FreeCamera::forward() const {
  return {std::sin(heading_) * std::cos(pitch_), std::sin(pitch_), -std::cos(heading_) * std::cos(pitch_)};
}

FreeCamera::Gaze FreeCamera::gaze() const { return {arrayOf(target_ - distance_ * forward()), arrayOf(target_)}; }

void FreeCamera::turn(double right, double up) {
  const glm::dvec3 place = target_ - distance_ * forward();
  // The dragged surface must follow the pointer. Inside a hollow, the camera turns in place, opposite to the drag.
  // Outside of an object, the camera moves around the target, opposite to the drag; so the near side of the object
  // follows the pointer, although the camera itself turns in the direction of the drag.
  const double way = inside_ ? -1 : 1;
  heading_ += way * right;
  pitch_ = std::clamp(pitch_ + way * up, -kSteepest, kSteepest);
  if (inside_) target_ = place + distance_ * forward();
}

void FreeCamera::move(double right, double up, double ahead) {
  const glm::dvec3 along = forward(), aside = rightOf(along);
  target_ += right * aside + up * glm::cross(aside, along) + ahead * along;
}

void FreeCamera::approach(double factor) {
  if (inside_) return move(0, 0, (1 - factor) * distance_);
  distance_ = std::max(distance_ * factor, kNearest);
}

glm::dvec3 rayThrough(const FreeCamera::Gaze& gaze, double fov, double aspect, double x, double y) {
  const glm::dvec3 along = glm::normalize(pointOf(gaze[1]) - pointOf(gaze[0]));
  const glm::dvec3 right = rightOf(along), up = glm::cross(right, along);
  const double half = std::tan(fov / 2);
  return along + right * ((2 * x - 1) * half * aspect) + up * ((1 - 2 * y) * half);
}

}  // namespace sgm::preview
