#include "tools/render/traced_scene.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "tools/render/foliage.h"

namespace sgm {

namespace {

/// Whether the material is a clear window pane, which shows the scene behind it; see kClearPane.
bool isClearPane(const RenderMaterial& material) {
  return material.pattern == SurfacePattern::glass && material.relief == kClearPane;
}

}  // namespace

LetsLight letsLight(const RenderMaterial& material) {
  if (material.pattern == SurfacePattern::glowing || material.pattern == SurfacePattern::leaded ||
      isClearPane(material))
    return LetsLight::always;
  return hasLeaves(material) ? LetsLight::in_spots : LetsLight::never;
}

vec3 TracedScene::directionAt(uint32_t x, uint32_t y, glm::vec2 off) const {
  const float first = 0.5f / static_cast<float>(scene_.supersample);
  const float u = (static_cast<float>(x) + first + off.x) / static_cast<float>(frame_.size.x) * 2 - 1;
  const float v = (static_cast<float>(y) + first + off.y) / static_cast<float>(frame_.size.y) * 2 - 1;
  return glm::normalize(vec3(frame_.forward) + u * vec3(frame_.right) - v * vec3(frame_.up));
}

MetSurface TracedScene::seenAt(uint32_t x, uint32_t y) const {
  constexpr int kMaxGaps = 6;
  constexpr float kBehind = 0.02f;  // metres
  const vec3 direction = directionAt(x, y);
  vec3 from(frame_.eye);
  MetSurface place = meet(from, direction);
  for (int i = 0; i < kMaxGaps && isGap(place, direction); ++i) {
    from = place.position + kBehind * direction;
    place = meet(from, direction);
    if (place.isThere()) place.distance = glm::distance(place.position, vec3(frame_.eye));
  }
  return place;
}

MetSurface TracedScene::meet(vec3 from, vec3 direction) const {
  const auto hit = mesh_.castFronts(from, direction, kLongestRay);
  if (!hit) return {};
  MetSurface place;
  place.distance = hit->distance;
  place.position = from + direction * hit->distance;
  const std::array<float, 3> share{1 - hit->u - hit->v, hit->u, hit->v};
  const vec3 facet = glm::normalize(hit->facing);
  vec3 lifted(0);
  for (int i = 0; i < 3; ++i) {
    const RenderVertex& vertex = mesh_.vertex(hit->triangle, i);
    place.normal += share[static_cast<size_t>(i)] * vertex.normal;
    // Lift the start of secondary rays to the curved surface that the normals suggest (Hanika, "Hacking the shadow
    // terminator", 2021).
    const vec3 from_corner = place.position - vertex.position;
    lifted += share[static_cast<size_t>(i)] * std::min(0.0f, dot(from_corner, vertex.normal)) * vertex.normal;
  }
  const float length = glm::length(place.normal);
  place.normal = length > 0.1f ? place.normal / length : facet;
  place.start = place.position - lifted + facet * (1e-3f + 2e-4f * hit->distance);
  place.triangle = hit->triangle;
  place.material = mesh_.vertex(hit->triangle, 0).material;
  place.second = mesh_.vertex(hit->triangle, 0).second;
  return place;
}

bool TracedScene::isMirror(uint32_t index) const {
  constexpr float kSmooth = 0.1f;
  const RenderMaterial& look = material(index);
  const bool lacquer = look.pattern == SurfacePattern::plain && look.relief == 0 && look.roughness <= kSmooth;
  return lacquer || isWater(index) || look.pattern == SurfacePattern::glass;
}

bool TracedScene::isClear(uint32_t index) const { return isClearPane(material(index)); }

bool TracedScene::hasWater() const {
  return std::ranges::any_of(scene_.materials,
                             [](const RenderMaterial& one) { return one.pattern == SurfacePattern::water; });
}

bool TracedScene::isGap(const MetSurface& place, vec3 direction) const {
  if (!place.isThere()) return false;
  const auto corner = [&](int i) { return &mesh_.vertex(place.triangle, i); };
  return isCrown(scene_, frame_, {corner(0), corner(1), corner(2)}) &&
         isCrownGap(frame_, place.position, -dot(place.normal, direction));
}

}  // namespace sgm
