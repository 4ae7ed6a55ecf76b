#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>
#include <new>
#include <optional>
#include <utility>

#include "tools/render/brightness_tally.h"
#include "tools/render/foliage.h"
#include "tools/render/light_filter.h"
#include "tools/render/light_paths.h"
#include "tools/render/light_planes.h"
#include "tools/render/pane.h"
#include "tools/render/ray_caster.h"
#include "tools/render/sampling.h"
#include "tools/render/traced_scene.h"
#include "tools/render/weather_marks.h"

namespace sgm {
namespace {

constexpr int kSoftRays = 14;       // number of rays for the indirect light of each square of pixels; a filter removes
                                    // the noise
constexpr int kBounces = 2;         // number of bounces of an indirect ray; a constant stands for further bounces
constexpr int kMirrorBounces = 2;   // number of bounces of a reflected ray
constexpr int kMirrorRays = 4;      // number of rays for a mirroring pixel: a single ray would alias edges in the
                                    // mirror
constexpr float kDirtReach = 0.9f;  // metres; a surface gets dirty where another surface is nearer than this

/// Computes the light of single pixels in a traced scene.
class LightTracer {
 public:
  /// vapour: the scene's clouds, or null if there are none.
  LightTracer(const TracedScene& scene, const Vapour* vapour)
      : scene_(scene), paths_(scene, vapour), vapour_(vapour), has_water_(scene.hasWater()) {}

  /// The light of the clouds between the eye and a surface, or along the whole ray if there is no surface.
  VapourLight vapourAt(const MetSurface& place, uint32_t x, uint32_t y) const {
    return vapour_->march(vec3(scene_.frame().eye), scene_.directionAt(x, y),
                          place.isThere() ? place.distance : kLongestRay, x, y);
  }

  DirectLight direct(const MetSurface& place, uint32_t x, uint32_t y) const {
    DirectLight light;
    for (uint32_t i = 0; i < paths_.lights(); ++i) {
      UnitPoints points(x, y, i);
      const float open = paths_.openShare(i, place, points);
      light.open[i / 4] |= static_cast<uint32_t>(open * 255 + 0.5f) << (8 * (i % 4));
    }
    float wet = 0;
    vec3 seen(0);
    if (scene_.isMirror(place.material)) seen = mirrored(place, x, y);
    // At the rim of a pane, the pane's material blends with the paint of the frame. Such pixels get the pane's weak
    // reflection and the view through the pane, even if paint is the first material. Otherwise, only the sky would
    // shine in the pane.
    if (scene_.isClear(place.material) || scene_.isClear(place.second)) {
      const uint32_t pane = scene_.isClear(place.material) ? place.material : place.second;
      // For clear panes, `seen` is the sum of reflected and transmitted light, and the shader adds it unchanged.
      const float facing = -dot(scene_.directionAt(x, y), place.normal);
      const float mirrors = 0.06f + 0.94f * std::pow(1 - std::clamp(facing, 0.0f, 1.0f), 5.0f);
      seen = mix(scene_.colourOf(pane) * seenThrough(place, x, y), seen, mirrors);
    } else if (scene_.isLeaded(place.material)) {
      seen = seenThrough(place, x, y);
    }
    if (has_water_) {
      UnitPoints points(x, y, 65);
      wet = scene_.isWater(place.material) ? depthOf(scene_, place, points) : -wetness(scene_, place);
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
      float distance = kLongestRay;
      // The limit prevents fireflies: single samples that are very bright because a lamp is near.
      const vec3 light = glm::min(paths_.radiance(place.start, direction, turns, kBounces, &distance), vec3(6.0f));
      near += std::max(0.0f, 1 - distance / kDirtReach);
      sum += light;
      lean += direction * luminance(light);
    }
    SoftLight result;
    result.lean = glm::vec4(lean / std::max(luminance(sum), 1e-12f), 0);
    result.light = glm::vec4(sum / static_cast<float>(kSoftRays), 1);
    if (paths_.isUnderSky())
      result.lie = {near / static_cast<float>(kSoftRays), ledgeOver(scene_, place), footUnder(scene_, place), 0};
    return result;
  }

  /// The total of direct and indirect light that falls on a place.
  vec3 lightOn(const MetSurface& place, const DirectLight& direct, const SoftLight& soft) const {
    vec3 light(soft.light);
    for (uint32_t i = 0; i < paths_.lights(); ++i) {
      const float open = static_cast<float>(direct.open[i / 4] >> (8 * (i % 4)) & 255u) / 255;
      if (open > 0) light += open * paths_.lightOf(i, place);
    }
    return light;
  }

  /// The brightness of a place in the given light. The material's plain colour is used, without the material's pattern.
  float brightness(const MetSurface& place, vec3 light) const {
    const vec3 colour = scene_.colourOf(place.material);
    if (paths_.isUnderSky()) return luminance(light * colour);
    // Under lamps, a dark material such as lava counts as brighter than it is, but not as bright as stone of albedo
    // kStone. Otherwise the exposure would rise until the dark material looks pale.
    constexpr float kStone = 0.3f;
    return luminance(light * colour) * std::sqrt(kStone / std::clamp(luminance(colour), 0.02f, kStone));
  }

 private:
  /// The reflection in a mirroring pixel: the mean of rays that are spread over the pixel, each reflected at its own
  /// point.
  vec3 mirrored(const MetSurface& place, uint32_t x, uint32_t y) const {
    UnitPoints spread(x, y, 63), turns(x, y, 64);
    const vec3 eye(scene_.frame().eye);
    const float facing = dot(place.position - eye, place.normal);
    vec3 sum(0);
    for (int i = 0; i < kMirrorRays; ++i) {
      const vec3 through = scene_.directionAt(x, y, spread.next() - 0.5f);
      // Intersect the ray with the mirror's plane, unless the plane is seen nearly edge-on.
      const float steep = dot(through, place.normal), way = facing / std::min(steep, -1e-4f);
      const vec3 beside = steep < 0 && way < 1.5f * place.distance ? eye + way * through - place.position : vec3(0);
      const vec3 at = place.position + beside + vec3(scene_.frame().pattern_offset);
      const SurfacePattern pattern = scene_.material(place.material).pattern;
      const vec3 normal = pattern == SurfacePattern::glass                          ? paneNormal(place.normal, at)
                          : pattern == SurfacePattern::water && paths_.isUnderSky() ? rippledNormal(place.normal, at)
                                                                                    : place.normal;
      vec3 back = glm::reflect(glm::normalize(place.position + beside - eye), normal);
      // At grazing angles, the distorted normal would reflect the ray into the pane: mirror the ray back to the outer
      // side.
      if (const float outwards = dot(back, place.normal); outwards < 0) back -= 2 * outwards * place.normal;
      sum += paths_.radiance(place.start + beside, back, turns, kMirrorBounces, nullptr, true);
    }
    return sum / static_cast<float>(kMirrorRays);
  }

  /// The light from the scene behind a pane; old leaded glass bends and blurs it.
  vec3 seenThrough(const MetSurface& place, uint32_t x, uint32_t y) const {
    UnitPoints spread(x, y, 66), turns(x, y, 67);
    const bool old = scene_.isLeaded(place.material);
    const float blur = old ? 0.2f : 0.0f;
    const vec3 bent = (old ? 2.0f : 0.0f) *
                      (paneNormal(place.normal, place.position + vec3(scene_.frame().pattern_offset)) - place.normal);
    const Across across(scene_.directionAt(x, y));
    vec3 sum(0);
    for (int i = 0; i < kMirrorRays; ++i) {
      const glm::vec2 off = blur * onDisc(spread.next());
      const vec3 direction = glm::normalize(scene_.directionAt(x, y) + bent + off.x * across.x + off.y * across.y);
      sum += paths_.radiance(behind(place, direction), direction, turns, kMirrorBounces, nullptr, true);
    }
    return sum / static_cast<float>(kMirrorRays);
  }

  const TracedScene& scene_;
  LightPaths paths_;
  const Vapour* vapour_;
  bool has_water_;
};

}  // namespace

Result<LightPlanes> traceLight(const RenderScene& scene, const RenderFrame& frame, JobSystem& jobs) {
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
    const TracedScene traced(scene, frame, *mesh);
    const LightTracer tracer(traced, vapour ? &*vapour : nullptr);
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
          const MetSurface place = traced.seenAt(x, y);
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
