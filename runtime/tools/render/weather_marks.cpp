#include "tools/render/weather_marks.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace sgm {

namespace {

constexpr float kUnderLedge = 2.4f;      // metres, length of the streaks that rain leaves below a ledge
constexpr float kSplash = 1.5f;          // metres, height up to which rain splashes a wall and damp rises in it
constexpr float kWiderThanLedge = 0.4f;  // metres; rain splashes a wall only if the flat ground before it is wider than
                                         // this
constexpr float kLedgeStep = 0.25f;      // metres; the ground before the wall is flat if its height differs by less
                                         // than this

}  // namespace

float depthOf(const TracedScene& scene, const MetSurface& place, UnitPoints& points) {
  constexpr int kWays = 8;
  constexpr float kFall = 0.33f, kDeepest = 8;
  float shallow = 0;
  const float turn = points.next().x;
  for (int i = 0; i < kWays; ++i) {
    const float angle = 6.28318531f * (static_cast<float>(i) + turn) / kWays;
    const auto shore =
        scene.mesh().castFronts(place.start, vec3(std::cos(angle), 0.02f, std::sin(angle)), kDeepest / kFall);
    shallow += 1 / (0.02f + (shore ? shore->distance * kFall : kDeepest));
  }
  return kWays / shallow;
}

float wetness(const TracedScene& scene, const MetSurface& place) {
  constexpr float kHigh = 0.35f;  // metres
  const vec3 out = glm::normalize(vec3(place.normal.x, 0, place.normal.z) + vec3(1e-5f, 0, 0));
  const auto below =
      scene.mesh().castFronts(place.start + 0.03f * out, glm::normalize(vec3(0.35f * out.x, -1, 0.35f * out.z)), kHigh);
  if (!below || !scene.isWater(scene.mesh().vertex(below->triangle, 0).material)) return 0;
  return 1 - below->distance / kHigh;
}

float ledgeOver(const TracedScene& scene, const MetSurface& place) {
  if (std::abs(place.normal.y) > 0.5f) return 0;
  const auto over =
      scene.mesh().castFronts(place.start, glm::normalize(vec3(0, 1, 0) + 0.12f * place.normal), kUnderLedge);
  return over ? 1 - over->distance / kUnderLedge : 0;
}

float footUnder(const TracedScene& scene, const MetSurface& place) {
  if (std::abs(place.normal.y) > 0.7f) return 0;
  const vec3 down(0, -1, 0);
  const auto under = scene.mesh().castFronts(place.start, glm::normalize(down + 0.10f * place.normal), kSplash);
  if (!under || under->facing.y <= 0.5f * glm::length(under->facing)) return 0;
  const vec3 away = place.start + kWiderThanLedge * place.normal;
  const auto beside = scene.mesh().castFronts(away, down, under->distance + kLedgeStep);
  return beside && beside->distance > under->distance - kLedgeStep ? 1 - under->distance / kSplash : 0;
}

}  // namespace sgm
