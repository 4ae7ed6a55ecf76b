#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include "tools/render/brightness_tally.h"
#include "tools/render/foliage.h"
#include "tools/render/illuminated.h"
#include "tools/render/light_filter.h"
#include "tools/render/light_planes.h"
#include "tools/render/pane.h"
#include "tools/render/ray_caster.h"
#include "tools/render/sampling.h"

namespace sgm {
namespace {

constexpr int kSoftRays = 14;  // rays for each square of pixels; their noise is filtered later
/// Numbers of rays to a light: the first rays suffice for places in full light or full shade; all of them resolve
/// penumbras.
constexpr int kFirstRays = 2, kAllRays = 8;
constexpr int kBounces = 2;    // reflections of a soft ray, after which the remaining light is assumed to be even
constexpr int kMostPanes = 2;  // maximum number of panes that a ray passes before it hits another surface
constexpr float kThroughPane = 0.8f;  // share of the light that lead and dirt of a stained window transmit
constexpr int kMirrorBounces = 2;     // further reflections of a ray that a mirror has reflected
constexpr int kMirrorRays = 4;  // rays of a pixel that shows a mirror: a single ray would alias edges in the reflection
// Radius of the sun's disc at distance 1, larger than the real one, as in slight haze.
constexpr float kSunRadius = 0.012f;
constexpr float kLampRadius = 0.05f;  // radius of a lamp, as a share of its reach
constexpr float kFar = 1e5f;          // metres, length of rays that go to infinity
constexpr float kDirtReach = 0.9f;    // metres: surfaces with other surfaces nearer than this catch dirt
constexpr float kUnderLedge = 2.4f;   // metres, length of rain streaks below a ledge
constexpr float kSplash = 1.5f;       // metres, height reached by splashing rain and rising damp
// metres: minimum width of ground at the foot of a wall from which rain splashes
constexpr float kWiderThanLedge = 0.4f;
constexpr float kLedgeStep = 0.25f;  // metres, height differences of the ground that are tolerated within that width

/// The surface that a ray hits.
struct MetSurface {
  vec3 position{0};
  vec3 normal{0};  ///< interpolated as for shading, unit length
  /// Starting point of further rays: moved off the triangle to the curved surface that the normals describe.
  vec3 start{0};
  uint32_t triangle = 0;
  uint32_t material = 0;
  uint32_t second = 0;  ///< index of the material to blend with
  float distance = -1;  ///< below 0: no surface

  bool isThere() const { return distance >= 0; }
};

/// Whether a pane is clear, so that the scene behind it is visible (kClearPane).
bool isClear(const RenderMaterial& material) {
  return material.pattern == SurfacePattern::glass && material.relief == kClearPane;
}

LetsLight letsLight(const RenderMaterial& material) {
  if (material.pattern == SurfacePattern::glowing || material.pattern == SurfacePattern::leaded || isClear(material))
    return LetsLight::always;
  return hasLeaves(material) ? LetsLight::in_spots : LetsLight::never;
}

float luminance(vec3 c) { return dot(c, vec3(0.2126f, 0.7152f, 0.0722f)); }

class LightTracer {
 public:
  /// vapour: the scene's clouds; null if there are none.
  LightTracer(const RenderScene& scene, const Frame& frame, const RayCaster& mesh, const Vapour* vapour)
      : scene_(scene),
        frame_(frame),
        mesh_(mesh),
        vapour_(vapour),
        to_sun_(frame.sun),
        sky_(scene.background == Background::sky) {
    for (const RenderMaterial& one : scene.materials) has_water_ |= one.pattern == SurfacePattern::water;
  }

  /// The direction of the ray through a pixel's first sample, or `off` pixels beside it.
  vec3 directionAt(uint32_t x, uint32_t y, glm::vec2 off = glm::vec2(0)) const {
    const float first = 0.5f / static_cast<float>(scene_.supersample);
    const float u = (static_cast<float>(x) + first + off.x) / static_cast<float>(frame_.size.x) * 2 - 1;
    const float v = (static_cast<float>(y) + first + off.y) / static_cast<float>(frame_.size.y) * 2 - 1;
    return glm::normalize(vec3(frame_.forward) + u * vec3(frame_.right) - v * vec3(frame_.up));
  }

  /// The visible surface in a pixel. The ray passes through gaps in tree crowns.
  MetSurface seenAt(uint32_t x, uint32_t y) const {
    constexpr int kMostGaps = 6;
    constexpr float kBehind = 0.02f;  // metres behind a gap at which the ray continues
    const vec3 direction = directionAt(x, y);
    vec3 from(frame_.eye);
    MetSurface place = meet(from, direction);
    for (int i = 0; i < kMostGaps && isGap(place, direction); ++i) {
      from = place.position + kBehind * direction;
      place = meet(from, direction);
      if (place.isThere()) place.distance = glm::distance(place.position, vec3(frame_.eye));
    }
    return place;
  }

  /// The clouds between the eye and a surface, or the sky.
  VapourLight vapourAt(const MetSurface& place, uint32_t x, uint32_t y) const {
    return vapour_->march(vec3(frame_.eye), directionAt(x, y), place.isThere() ? place.distance : kFar, x, y);
  }

  DirectLight direct(const MetSurface& place, uint32_t x, uint32_t y) const {
    DirectLight light;
    const uint32_t lights = sky_ ? 1 : frame_.counts.x;
    for (uint32_t i = 0; i < lights; ++i) {
      UnitPoints points(x, y, i);
      const float open = sky_ ? sunShare(place, points) : lampShare(place, i, points);
      light.open[i / 4] |= static_cast<uint32_t>(open * 255 + 0.5f) << (8 * (i % 4));
    }
    float wet = 0;
    vec3 seen(0);
    if (isMirror(place.material)) seen = mirrored(place, x, y);
    // At the rim of a pane its material is blended with paint, which must then mirror as little as the pane does:
    // otherwise the sky alone would shine in the pane.
    if (isClear(material(place.material)) || isClear(material(place.second))) {
      const uint32_t pane = isClear(material(place.material)) ? place.material : place.second;
      // The shader adds this light unchanged, so reflection and transmission are combined here.
      const float facing = -dot(directionAt(x, y), place.normal);
      const float mirrors = 0.06f + 0.94f * std::pow(1 - std::clamp(facing, 0.0f, 1.0f), 5.0f);
      seen = mix(colourOf(pane) * seenThrough(place, x, y), seen, mirrors);
    } else if (isLeaded(place.material)) {
      seen = seenThrough(place, x, y);
    }
    if (has_water_) {
      UnitPoints points(x, y, 65);
      wet = isWater(place.material) ? depthOf(place, points) : -wetness(place);
    }
    light.mirror[0] = glm::packHalf2x16({seen.r, seen.g});
    light.mirror[1] = glm::packHalf2x16({seen.b, wet});
    return light;
  }

  SoftLight soft(const MetSurface& place, uint32_t x, uint32_t y) const {
    UnitPoints points(x, y, 32), turns(x, y, 33);
    vec3 sum(0), lean(0);
    float near = 0;
    for (int i = 0; i < kSoftRays; ++i) {
      const vec3 direction = cosineDirection(place.normal, points.next());
      float distance = kFar;
      // The limit prevents fireflies, single bright pixels from rays that hit a lamp at close range.
      const vec3 light = glm::min(radiance(place.start, direction, turns, kBounces, &distance), vec3(6.0f));
      near += std::max(0.0f, 1 - distance / kDirtReach);
      sum += light;
      lean += direction * luminance(light);
    }
    SoftLight result;
    result.lean = glm::vec4(lean / std::max(luminance(sum), 1e-12f), 0);
    result.light = glm::vec4(sum / static_cast<float>(kSoftRays), 1);
    if (sky_) result.lie = {near / static_cast<float>(kSoftRays), ledgeOver(place), footUnder(place), 0};
    return result;
  }

  /// The total light that falls on a place.
  vec3 lightOn(const MetSurface& place, const DirectLight& direct, const SoftLight& soft) const {
    vec3 light(soft.light);
    for (uint32_t i = 0; i < (sky_ ? 1 : frame_.counts.x); ++i) {
      const float open = static_cast<float>(direct.open[i / 4] >> (8 * (i % 4)) & 255u) / 255;
      if (open > 0) light += open * (sky_ ? sunOn(place.normal) : lampOn(place.position, place.normal, i));
    }
    return light;
  }

  /// The brightness with which a place of a plain colour appears in a light.
  float brightness(const MetSurface& place, vec3 light) const {
    const vec3 colour = colourOf(place.material);
    if (sky_) return luminance(light * colour);
    // Under lamps, dark materials such as lava are treated as dark, not as badly lit stone, so that they stay dark.
    constexpr float kStone = 0.3f;
    return luminance(light * colour) * std::sqrt(kStone / std::clamp(luminance(colour), 0.02f, kStone));
  }

 private:
  const RenderMaterial& material(uint32_t index) const {
    return scene_.materials[std::min<size_t>(index, scene_.materials.size() - 1)];
  }
  vec3 colourOf(uint32_t index) const { return material(index).colour; }
  /// Whether a material reflects like a mirror: water, panes, and equally smooth paint.
  bool isMirror(uint32_t index) const {
    constexpr float kSmooth = 0.1f;
    const RenderMaterial& look = material(index);
    const bool lacquer = look.pattern == SurfacePattern::plain && look.relief == 0 && look.roughness <= kSmooth;
    return lacquer || isWater(index) || look.pattern == SurfacePattern::glass;
  }

  /// The reflection in a pixel: the mean over rays through the whole pixel, each reflected at its own point of the
  /// mirror.
  vec3 mirrored(const MetSurface& place, uint32_t x, uint32_t y) const {
    UnitPoints spread(x, y, 63), turns(x, y, 64);
    const vec3 eye(frame_.eye);
    const float facing = dot(place.position - eye, place.normal);
    vec3 sum(0);
    for (int i = 0; i < kMirrorRays; ++i) {
      const vec3 through = directionAt(x, y, spread.next() - 0.5f);
      // The point where the ray meets the mirror's plane, unless the plane is seen nearly edge-on.
      const float steep = dot(through, place.normal), way = facing / std::min(steep, -1e-4f);
      const vec3 beside = steep < 0 && way < 1.5f * place.distance ? eye + way * through - place.position : vec3(0);
      const vec3 at = place.position + beside + vec3(frame_.pattern_offset);
      const SurfacePattern pattern = material(place.material).pattern;
      const vec3 normal = pattern == SurfacePattern::glass           ? paneNormal(place.normal, at)
                          : pattern == SurfacePattern::water && sky_ ? rippledNormal(place.normal, at)
                                                                     : place.normal;
      vec3 back = glm::reflect(glm::normalize(place.position + beside - eye), normal);
      // At grazing angles, the distorted normal would reflect the ray into the pane; reflect it out again.
      if (const float outwards = dot(back, place.normal); outwards < 0) back -= 2 * outwards * place.normal;
      sum += radiance(place.start + beside, back, turns, kMirrorBounces, nullptr, true);
    }
    return sum / static_cast<float>(kMirrorRays);
  }

  bool isGap(const MetSurface& place, vec3 direction) const {
    if (!place.isThere()) return false;
    const auto corner = [&](int i) { return &mesh_.vertex(place.triangle, i); };
    return isCrown(scene_, frame_, {corner(0), corner(1), corner(2)}) &&
           isCrownGap(frame_, place.position, -dot(place.normal, direction));
  }

  bool isLeaded(uint32_t index) const { return material(index).pattern == SurfacePattern::leaded; }

  /// Whether a material is a pane that transmits rays.
  bool isPane(uint32_t index) const { return isLeaded(index) || isClear(material(index)); }

  /// The scene behind a pane, as seen through a pixel. Old glass bends and blurs it.
  vec3 seenThrough(const MetSurface& place, uint32_t x, uint32_t y) const {
    UnitPoints spread(x, y, 66), turns(x, y, 67);
    const bool old = isLeaded(place.material);
    const float blur = old ? 0.2f : 0.0f;
    const vec3 bent =
        (old ? 2.0f : 0.0f) * (paneNormal(place.normal, place.position + vec3(frame_.pattern_offset)) - place.normal);
    const Across across(directionAt(x, y));
    vec3 sum(0);
    for (int i = 0; i < kMirrorRays; ++i) {
      const glm::vec2 off = blur * onDisc(spread.next());
      const vec3 direction = glm::normalize(directionAt(x, y) + bent + off.x * across.x + off.y * across.y);
      sum += radiance(behind(place, direction), direction, turns, kMirrorBounces, nullptr, true);
    }
    return sum / static_cast<float>(kMirrorRays);
  }

  bool isWater(uint32_t index) const { return material(index).pattern == SurfacePattern::water; }

  /// The depth of water at a place in metres. The bed is assumed to slope like the shore: the depth is a third of the
  /// distance to the shore, averaged over several directions.
  float depthOf(const MetSurface& place, UnitPoints& points) const {
    constexpr int kWays = 8;
    constexpr float kFall = 0.33f, kDeepest = 8;
    float shallow = 0;
    const float turn = points.next().x;
    for (int i = 0; i < kWays; ++i) {
      const float angle = 6.28318531f * (static_cast<float>(i) + turn) / kWays;
      const auto shore = mesh_.castFronts(place.start, vec3(std::cos(angle), 0.02f, std::sin(angle)), kDeepest / kFall);
      shallow += 1 / (0.02f + (shore ? shore->distance * kFall : kDeepest));
    }
    return kWays / shallow;
  }

  /// The wetness of a surface near water, 0..1: it decreases with the height above the water, to 0 at kHigh.
  float wetness(const MetSurface& place) const {
    constexpr float kHigh = 0.35f;  // metres
    const vec3 out = glm::normalize(vec3(place.normal.x, 0, place.normal.z) + vec3(1e-5f, 0, 0));
    const auto below =
        mesh_.castFronts(place.start + 0.03f * out, glm::normalize(vec3(0.35f * out.x, -1, 0.35f * out.z)), kHigh);
    if (!below || !isWater(mesh_.vertex(below->triangle, 0).material)) return 0;
    return 1 - below->distance / kHigh;
  }

  MetSurface meet(vec3 from, vec3 direction) const {
    const auto hit = mesh_.castFronts(from, direction, kFar);
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
      // Move the starting point outwards to the curved surface (Hanika, "Hacking the shadow terminator", 2021).
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

  /// Starting point of the ray that continues behind a window's surface: it lies inside the pane, so that the ray hits
  /// the pane's other side from inside.
  static vec3 behind(const MetSurface& pane, vec3 direction) { return pane.position + 2e-3f * direction; }

  vec3 sunOn(vec3 n) const { return sunLight() * std::max(0.0f, dot(n, to_sun_)); }

  vec3 lampOn(vec3 p, vec3 n, uint32_t lamp) const {
    const vec3 away = vec3(frame_.lamp_position[lamp]) - p;
    const float distance = glm::length(away), facing = dot(n, away) / std::max(distance, 1e-6f);
    if (facing <= 0) return vec3(0);
    float fall = lampFall(distance, frame_.lamp_position[lamp].w);
    if (lamp == 0) fall *= lampBeam(-dot(away, vec3(frame_.forward)) / std::max(distance, 1e-6f));
    return vec3(frame_.lamp_colour[lamp]) * (fall * facing);
  }

  /// The share of rays to a light that nothing blocks. reaches() casts the next ray.
  template <class Reaches>
  static float shareOf(Reaches reaches) {
    int open = 0, cast = 0;
    for (; cast < kFirstRays || (cast < kAllRays && open != 0 && open != cast); ++cast) open += reaches();
    return static_cast<float>(open) / static_cast<float>(cast);
  }

  float sunShare(const MetSurface& place, UnitPoints& points) const {
    // Surfaces that face away from the sun are dark, except translucent ones, which the sun lights from within.
    if (dot(place.normal, to_sun_) < -0.4f) return 0;
    const Across across(to_sun_);
    const float through = vapour_ ? vapour_->sunThrough(place.start) : 1;
    return through * shareOf([&] {
             const glm::vec2 at = kSunRadius * onDisc(points.next());
             return mesh_.isFree(place.start, glm::normalize(to_sun_ + at.x * across.x + at.y * across.y), kFar);
           });
  }

  float lampShare(const MetSurface& place, uint32_t lamp, UnitPoints& points) const {
    const vec3 away = vec3(frame_.lamp_position[lamp]) - place.start;
    const float reach = frame_.lamp_position[lamp].w, distance = glm::length(away);
    if (lampFall(distance, reach) <= 0 || distance <= 1e-4f || dot(place.normal, away) < -0.4f * distance) return 0;
    const vec3 towards = away / distance;
    const Across across(towards);
    return shareOf([&] {
      const glm::vec2 at = std::min(kLampRadius * reach, 0.25f * distance) * onDisc(points.next());
      return mesh_.isFree(place.start, away + at.x * across.x + at.y * across.y, 0.98f);
    });
  }

  /// The light of the sun and of all lamps that a mirrored place reflects. All lamps are summed, since choosing one at
  /// random would cause noise.
  vec3 litByAll(const MetSurface& place, UnitPoints& turns) const {
    if (sky_) return lit(place, turns.next());
    vec3 sum(0);
    for (uint32_t i = 0; i < frame_.counts.x; ++i) {
      const vec3 light = lampOn(place.position, place.normal, i);
      if (luminance(light) <= 1e-4f) continue;
      const vec3 away = vec3(frame_.lamp_position[i]) - place.start;
      const float distance = glm::length(away);
      const Across across(away / std::max(distance, 1e-6f));
      const glm::vec2 at = std::min(kLampRadius * frame_.lamp_position[i].w, 0.25f * distance) * onDisc(turns.next());
      if (mesh_.isFree(place.start, away + at.x * across.x + at.y * across.y, 0.98f)) sum += light;
    }
    return sum;
  }

  /// The light that a place reflects: of the sun, or of one lamp that is chosen with probability proportional to its
  /// unshadowed light.
  vec3 lit(const MetSurface& place, glm::vec2 turn) const {
    if (sky_) {
      const vec3 light = sunOn(place.normal);
      return light.r > 0 && mesh_.isFree(place.start, to_sun_, kFar) ? light : vec3(0);
    }
    std::array<vec3, kMaxLamps + 1> lights;
    float all = 0;
    for (uint32_t i = 0; i < frame_.counts.x; ++i)
      all += luminance(lights[i] = lampOn(place.position, place.normal, i));
    float left = turn.x * all;
    for (uint32_t i = 0; i < frame_.counts.x; ++i) {
      const float own = luminance(lights[i]);
      if (own <= 0 || (left -= own) > 0) continue;
      const vec3 away = vec3(frame_.lamp_position[i]) - place.start;
      return mesh_.isFree(place.start, away, 0.98f) ? lights[i] * (all / own) : vec3(0);
    }
    return vec3(0);
  }

  /// The sky with fair-weather clouds. Mirrors show single clouds; elsewhere their mean coverage is used.
  vec3 skyIn(vec3 from, vec3 direction, bool mirrored) const {
    vec3 sky = skyLight(direction, to_sun_);
    if (frame_.land.w > 0 && direction.y > 0) {
      constexpr float kShare = 0.15f;
      const float share = mirrored ? mirroredClouds(direction) : kShare;
      sky = mix(sky, vec3(1.05f, 1.05f, 1.03f), share * smoothstep(0.0f, 0.1f, direction.y));
    }
    return vapour_ ? vapour_->skyThrough(from, direction, sky) : sky;
  }

  /// How much a ledge above a wall keeps rain off, 0..1.
  float ledgeOver(const MetSurface& place) const {
    if (std::abs(place.normal.y) > 0.5f) return 0;
    const auto over = mesh_.castFronts(place.start, glm::normalize(vec3(0, 1, 0) + 0.12f * place.normal), kUnderLedge);
    return over ? 1 - over->distance / kUnderLedge : 0;
  }

  /// Nearness of a wall's foot, 0..1: of a flat surface at the wall that is wider than a ledge.
  float footUnder(const MetSurface& place) const {
    if (std::abs(place.normal.y) > 0.7f) return 0;
    const vec3 down(0, -1, 0);
    const auto under = mesh_.castFronts(place.start, glm::normalize(down + 0.10f * place.normal), kSplash);
    if (!under || under->facing.y <= 0.5f * glm::length(under->facing)) return 0;
    const vec3 away = place.start + kWiderThanLedge * place.normal;
    const auto beside = mesh_.castFronts(away, down, under->distance + kLedgeStep);
    return beside && beside->distance > under->distance - kLedgeStep ? 1 - under->distance / kSplash : 0;
  }

  /// The radiance that arrives along a ray. distance: is set to the distance of the first hit, if any. mirrored: the
  /// ray is visible in a mirror, so clouds must be distinct.
  vec3 radiance(vec3 from, vec3 direction, UnitPoints& turns, int bounces, float* distance = nullptr,
                bool mirrored = false) const {
    vec3 sum(0), weight(1);
    for (int i = 0; i < bounces; ++i) {
      MetSurface place = meet(from, direction);
      for (int panes = 0; panes < kMostPanes && place.isThere() && isPane(place.material); ++panes) {
        weight *= kThroughPane * colourOf(place.material);
        from = behind(place, direction);
        place = meet(from, direction);
      }
      if (distance && i == 0 && place.isThere()) *distance = place.distance;
      if (!place.isThere()) return sum + weight * (sky_ ? skyIn(from, direction, mirrored) : vec3(frame_.sun.w));
      // Ambient light is full in open places, and less in narrow clefts.
      const float wide = place.distance / (place.distance + 0.7f);
      sum += weight * (sky_ ? 0.0f : frame_.sun.w * wide);
      weight *= colourOf(place.material);
      sum += weight * (mirrored && i == 0 ? litByAll(place, turns) : lit(place, turns.next()));
      if (i + 1 == bounces) {
        sum += weight * (sky_ ? vec3(0.10f, 0.12f, 0.15f) : vec3(0.3f * frame_.sun.w));
        break;
      }
      from = place.start;
      direction = cosineDirection(place.normal, turns.next());
    }
    return sum;
  }

  const RenderScene& scene_;
  const Frame& frame_;
  const RayCaster& mesh_;
  const Vapour* vapour_;
  vec3 to_sun_;
  bool sky_;
  bool has_water_ = false;
};

}  // namespace

Result<LightPlanes> traceLight(const RenderScene& scene, const Frame& frame, JobSystem& jobs) {
  try {
    const SceneParts parts = partsOf(scene);
    Result<RayCaster> mesh = RayCaster::over(scene.vertices, parts.bodies);
    if (!mesh) return mesh.error();
    std::vector<LetsLight> lets;
    for (const RenderMaterial& one : scene.materials) lets.push_back(letsLight(one));
    if (!std::ranges::all_of(lets, [](LetsLight one) { return one == LetsLight::never; }))
      mesh->loosen(lets, vec3(frame.pattern_offset));
    std::optional<Vapour> vapour;
    if (!parts.clouds.empty()) {
      Result<Vapour> made = Vapour::over(scene, frame, parts.clouds, jobs);
      if (!made) return made.error();
      vapour = std::move(*made);
    }
    const LightTracer tracer(scene, frame, *mesh, vapour ? &*vapour : nullptr);
    LightPlanes planes;
    planes.width = frame.size.x;
    planes.height = frame.size.y;
    planes.soft_width = (planes.width + kSoftPixels - 1) / kSoftPixels;
    planes.soft_height = (planes.height + kSoftPixels - 1) / kSoftPixels;
    planes.direct.resize(size_t{planes.width} * planes.height);
    planes.soft.resize(size_t{planes.soft_width} * planes.soft_height);
    if (vapour) planes.vapour.resize(planes.direct.size());
    Guides fine(planes.width, planes.height), coarse(planes.soft_width, planes.soft_height);
    std::vector<BrightnessTally> rows(planes.soft_height), lit_rows(planes.soft_height);
    std::atomic<bool> stopped = false;
    parallelFor(jobs, planes.soft_height, [&](size_t row) {
      if (stopped || (scene.go_on && !scene.go_on())) {
        stopped = true;
        return;
      }
      const auto begin = static_cast<uint32_t>(row) * kSoftPixels;
      for (uint32_t y = begin; y < std::min(begin + kSoftPixels, planes.height); ++y) {
        for (uint32_t x = 0; x < planes.width; ++x) {
          const MetSurface place = tracer.seenAt(x, y);
          const size_t at = size_t{y} * planes.width + x;
          fine.set(at, place.position, place.normal, place.distance);
          if (vapour) planes.vapour[at] = tracer.vapourAt(place, x, y);
          if (!place.isThere()) continue;
          planes.direct[at] = tracer.direct(place, x, y);
          if (x % kSoftPixels != 0 || y != begin) continue;
          const size_t soft = row * planes.soft_width + x / kSoftPixels;
          coarse.set(soft, place.position, place.normal, place.distance);
          planes.soft[soft] = tracer.soft(place, x, y);
          const vec3 light = tracer.lightOn(place, planes.direct[at], planes.soft[soft]);
          rows[row].add(tracer.brightness(place, light));
          lit_rows[row].add(luminance(light));
        }
      }
    });
    if (stopped) return Error{Code::cancelled, "the picture was cancelled"};
    BrightnessTally all, lit;
    for (const BrightnessTally& row : rows) all.add(row);
    for (const BrightnessTally& row : lit_rows) lit.add(row);
    planes.lit = lit.mean();
    planes.brightness = all.mean();
    planes.highlight = all.highlight();
    const float sample = frame.eye.w * static_cast<float>(frame.size.z);
    filterSoft(planes.soft, coarse, sample * kSoftPixels, jobs);
    filterDirect(planes.direct, fine, sample, jobs);
    return planes;
  } catch (const std::bad_alloc&) {
    return Error{Code::out_of_memory, "out of memory while tracing light"};
  }
}

}  // namespace sgm
