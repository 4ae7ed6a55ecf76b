#include "tools/render/light_paths.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "tools/render/pane.h"

namespace sgm {

namespace {

/// Number of shadow rays to one light. If the first kFirstRays agree, the place is in full light or full shadow.
/// Otherwise it is in a penumbra, and kAllRays are cast.
constexpr int kFirstRays = 2, kAllRays = 8;
constexpr int kMaxPanes = 2;          // maximum number of window panes that a ray crosses between two surfaces
constexpr float kThroughPane = 0.8f;  // share of the light that a window pane transmits
constexpr float kSunRadius = 0.012f;  // radius of the sun's disc at distance 1, slightly enlarged by haze
constexpr float kLampRadius = 0.05f;  // radius of a lamp, as a fraction of its reach

/// The share of unblocked shadow rays. Each call of reaches() casts one ray and returns whether it is unblocked.
template <class Reaches>
float shareOf(Reaches reaches) {
  int open = 0, cast = 0;
  for (; cast < kFirstRays || (cast < kAllRays && open != 0 && open != cast); ++cast) open += reaches();
  return static_cast<float>(open) / static_cast<float>(cast);
}

}  // namespace

float luminance(vec3 colour) { return dot(colour, vec3(0.2126f, 0.7152f, 0.0722f)); }

vec3 LightPaths::sunOn(vec3 n) const { return sunLight() * std::max(0.0f, dot(n, to_sun_)); }

vec3 LightPaths::lampOn(vec3 p, vec3 n, uint32_t lamp) const {
  const vec3 away = vec3(scene_.frame().lamp_position[lamp]) - p;
  const float distance = glm::length(away), facing = dot(n, away) / std::max(distance, 1e-6f);
  if (facing <= 0) return vec3(0);
  float fall = lampFall(distance, scene_.frame().lamp_position[lamp].w);
  if (lamp == 0) fall *= lampBeam(-dot(away, vec3(scene_.frame().forward)) / std::max(distance, 1e-6f));
  return vec3(scene_.frame().lamp_colour[lamp]) * (fall * facing);
}

float LightPaths::sunShare(const MetSurface& place, UnitPoints& points) const {
  // Surfaces that face away from the sun are dark. The tolerance is for translucent surfaces.
  if (dot(place.normal, to_sun_) < -0.4f) return 0;
  const Across across(to_sun_);
  const float through = vapour_ ? vapour_->sunThrough(place.start) : 1;
  return through * shareOf([&] {
           const glm::vec2 at = kSunRadius * onDisc(points.next());
           return scene_.mesh().isFree(place.start, glm::normalize(to_sun_ + at.x * across.x + at.y * across.y),
                                       kLongestRay);
         });
}

float LightPaths::lampShare(const MetSurface& place, uint32_t lamp, UnitPoints& points) const {
  const vec3 away = vec3(scene_.frame().lamp_position[lamp]) - place.start;
  const float reach = scene_.frame().lamp_position[lamp].w, distance = glm::length(away);
  if (lampFall(distance, reach) <= 0 || distance <= 1e-4f || dot(place.normal, away) < -0.4f * distance) return 0;
  const vec3 towards = away / distance;
  const Across across(towards);
  return shareOf([&] {
    const glm::vec2 at = std::min(kLampRadius * reach, 0.25f * distance) * onDisc(points.next());
    return scene_.mesh().isFree(place.start, away + at.x * across.x + at.y * across.y, 0.98f);
  });
}

vec3 LightPaths::litByAll(const MetSurface& place, UnitPoints& turns) const {
  if (sky_) return lit(place, turns.next());
  vec3 sum(0);
  for (uint32_t i = 0; i < scene_.frame().counts.x; ++i) {
    const vec3 light = lampOn(place.position, place.normal, i);
    if (luminance(light) <= 1e-4f) continue;
    const vec3 away = vec3(scene_.frame().lamp_position[i]) - place.start;
    const float distance = glm::length(away);
    const Across across(away / std::max(distance, 1e-6f));
    const glm::vec2 at =
        std::min(kLampRadius * scene_.frame().lamp_position[i].w, 0.25f * distance) * onDisc(turns.next());
    if (scene_.mesh().isFree(place.start, away + at.x * across.x + at.y * across.y, 0.98f)) sum += light;
  }
  return sum;
}

vec3 LightPaths::lit(const MetSurface& place, glm::vec2 turn) const {
  if (sky_) {
    const vec3 light = sunOn(place.normal);
    return light.r > 0 && scene_.mesh().isFree(place.start, to_sun_, kLongestRay) ? light : vec3(0);
  }
  std::array<vec3, kMaxLamps + 1> lights;
  float all = 0;
  for (uint32_t i = 0; i < scene_.frame().counts.x; ++i)
    all += luminance(lights[i] = lampOn(place.position, place.normal, i));
  float left = turn.x * all;
  for (uint32_t i = 0; i < scene_.frame().counts.x; ++i) {
    const float own = luminance(lights[i]);
    if (own <= 0 || (left -= own) > 0) continue;
    const vec3 away = vec3(scene_.frame().lamp_position[i]) - place.start;
    return scene_.mesh().isFree(place.start, away, 0.98f) ? lights[i] * (all / own) : vec3(0);
  }
  return vec3(0);
}

vec3 LightPaths::skyIn(vec3 from, vec3 direction, bool mirrored) const {
  vec3 sky = skyLight(direction, to_sun_);
  if (scene_.frame().land.w > 0 && direction.y > 0) {
    constexpr float kShare = 0.15f;
    const float share = mirrored ? mirroredClouds(direction) : kShare;
    sky = mix(sky, vec3(1.05f, 1.05f, 1.03f), share * smoothstep(0.0f, 0.1f, direction.y));
  }
  return vapour_ ? vapour_->skyThrough(from, direction, sky) : sky;
}

vec3 LightPaths::radiance(vec3 from, vec3 direction, UnitPoints& turns, int bounces, float* distance,
                          bool mirrored) const {
  vec3 sum(0), weight(1);
  for (int i = 0; i < bounces; ++i) {
    MetSurface place = scene_.meet(from, direction);
    for (int panes = 0; panes < kMaxPanes && place.isThere() && scene_.isPane(place.material); ++panes) {
      weight *= kThroughPane * scene_.colourOf(place.material);
      from = behind(place, direction);
      place = scene_.meet(from, direction);
    }
    if (distance && i == 0 && place.isThere()) *distance = place.distance;
    if (!place.isThere()) return sum + weight * (sky_ ? skyIn(from, direction, mirrored) : vec3(scene_.frame().sun.w));
    // Ambient light arrives fully in open space, and less in narrow clefts.
    const float wide = place.distance / (place.distance + 0.7f);
    sum += weight * (sky_ ? 0.0f : scene_.frame().sun.w * wide);
    weight *= scene_.colourOf(place.material);
    sum += weight * (mirrored && i == 0 ? litByAll(place, turns) : lit(place, turns.next()));
    if (i + 1 == bounces) {
      sum += weight * (sky_ ? vec3(0.10f, 0.12f, 0.15f) : vec3(0.3f * scene_.frame().sun.w));
      break;
    }
    from = place.start;
    direction = cosineDirection(place.normal, turns.next());
  }
  return sum;
}

}  // namespace sgm
