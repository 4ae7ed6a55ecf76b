#include "tools/flight/daylight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace sgm::cli {
namespace {

// Numbers of rays across a picture and down it; no ray passes through the exact centre.
constexpr size_t kColumns = 6, kRows = 4;
constexpr double kViewMetres = 256;  // length of the view rays; farther surfaces cover little of a picture
constexpr double kGoldenAngle = 2.399963229728653;
/// Length of the upward rays. A ray that hits nothing within this length counts as reaching the sky. The lengths apply
/// to an open world, to an open world with endlessly stacked grammar cells, and to caves in rock, which may be high.
/// They are limited because the world must be derived along each ray.
constexpr double kSkyMetres = 256, kEndlessSkyMetres = 128, kRockSkyMetres = 1024;
/// Daylight is clearly above (below) the threshold kEnoughDaylight if it is more (less) than this factor times the
/// threshold.
constexpr double kClearlyMore = 1.5, kClearlyLess = 0.5;

/// Five directions: straight up, and four at 30 degrees above the horizon, spaced by 90 degrees. `turn` rotates these
/// four about the vertical; the caller varies it between places.
std::array<Metres3, 5> upwards(double turn) {
  std::array<Metres3, 5> directions{Metres3{0, 1, 0}};
  const double height = glm::radians(30.0);
  for (size_t i = 0; i < 4; ++i) {
    const double around = turn + glm::radians(90.0 * static_cast<double>(i));
    directions[i + 1] = {std::cos(height) * std::cos(around), std::sin(height), std::cos(height) * std::sin(around)};
  }
  return directions;
}

bool letsThrough(const LitWorld& world, const RayEnd& end) {
  return end.material < world.translucent.size() && world.translucent[end.material];
}

/// Returns how much of the sky is open: the share of the five upward directions in which light of the sky reaches a
/// place.
Result<double> openness(const LitWorld& world, const Metres3& place, double turn) {
  const std::array<Metres3, 5> directions = upwards(turn);
  int open = 0;
  for (const Metres3& direction : directions) {
    const Result<std::optional<RayEnd>> end = world.cast(place, direction, world.sky_metres);
    if (!end) return end.error();
    open += !*end || letsThrough(world, **end);
  }
  return static_cast<double>(open) / static_cast<double>(directions.size());
}

}  // namespace

LitWorld LitWorld::of(bool solid, bool endless_height) {
  LitWorld world;
  world.roofless = !(solid && endless_height);
  world.sky_metres = solid ? kRockSkyMetres : endless_height ? kEndlessSkyMetres : kSkyMetres;
  return world;
}

bool isTranslucent(std::string_view material) {
  const SurfacePattern pattern = materialByName(material).pattern;
  return pattern == SurfacePattern::glass || pattern == SurfacePattern::leaded || pattern == SurfacePattern::cloud;
}

Result<Outlook> lookOut(const LitWorld& world, const CameraPlace& camera) {
  const Metres3 forward = glm::normalize(camera.direction);
  const Metres3 level = glm::cross(forward, Metres3{0, 1, 0});
  const Metres3 right = glm::dot(level, level) > 1e-9 ? glm::normalize(level) : Metres3{1, 0, 0};
  const Metres3 up = glm::cross(right, forward);
  const double half_height = std::tan(glm::radians(camera.fov_degrees) / 2), half_width = half_height * camera.aspect;
  std::array<double, kColumns * kRows> distances{};
  double sum = 0;
  for (size_t i = 0; i < distances.size(); ++i) {
    const auto column = static_cast<double>(i % kColumns), row = static_cast<double>(i / kColumns);
    const double u = (2 * column + 1) / kColumns - 1, v = (2 * row + 1) / kRows - 1;
    const Metres3 direction = glm::normalize(forward + right * (u * half_width) + up * (v * half_height));
    const Result<std::optional<RayEnd>> seen = world.cast(camera.position, direction, kViewMetres);
    if (!seen) return seen.error();
    if (*seen && (*seen)->inside) return Outlook{0, true};
    distances[i] = *seen ? (*seen)->distance : kViewMetres;
    if (!world.roofless) continue;
    if (*seen && letsThrough(world, **seen)) {
      sum += 1;
      continue;
    }
    Metres3 place = camera.position + direction * distances[i];
    if (*seen) place += (*seen)->normal * world.clearance_metres;
    const Result<double> open = openness(world, place, kGoldenAngle * static_cast<double>(i));
    if (!open) return open.error();
    sum += *open;
  }
  std::ranges::sort(distances);
  // The depth of the view is the mean of the median and the upper quartile of the distances. The median alone would be
  // too small: many rays hit near surfaces that only frame the view.
  const double depth = (distances[distances.size() / 2] + distances[distances.size() * 3 / 4]) / 2;
  return Outlook{sum / static_cast<double>(distances.size()), false, depth};
}

std::optional<Light> lightNamed(std::string_view name) {
  for (const Light light : {Light::sun, Light::lamp, Light::none})
    if (name == lightName(light)) return light;
  return {};
}

const char* lightName(Light light) {
  switch (light) {
    case Light::sun:
      return "sun";
    case Light::lamp:
      return "lamp";
    case Light::none:
      break;
  }
  return "none";
}

Light lightAt(double daylight) { return daylight >= kEnoughDaylight ? Light::sun : Light::lamp; }

Light SteadyLight::next(double daylight, bool anew) {
  if (!light_ || anew) {
    light_ = lightAt(daylight);
    doubted_ = false;
    return *light_;
  }
  const bool other =
      *light_ == Light::sun ? daylight < kClearlyLess * kEnoughDaylight : daylight > kClearlyMore * kEnoughDaylight;
  if (other && doubted_) light_ = lightAt(daylight);
  doubted_ = other && !doubted_;
  return *light_;
}

}  // namespace sgm::cli
