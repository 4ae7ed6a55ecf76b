#include "tools/render/sketch.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <new>

#include "tools/render/brightness_tally.h"
#include "tools/render/frame.h"
#include "tools/render/illuminated.h"
#include "tools/render/sampling.h"

namespace sgm {
namespace {

constexpr int kNearRays = 4;  // number of rays that measure how open the surroundings of a place are
constexpr float kFar = 1e5f;  // metres, maximum length of a ray

class Sketch {
 public:
  Sketch(const RenderScene& scene, const RayCaster& mesh)
      : scene_(scene),
        frame_(frameOf(scene)),
        mesh_(mesh),
        to_sun_(frame_.sun),
        sky_(scene.background == Background::sky) {}

  vec3 at(int x, int y) const {
    const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(scene_.camera.width) * 2 - 1;
    const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(scene_.camera.height) * 2 - 1;
    const vec3 way = glm::normalize(vec3(frame_.forward) + u * vec3(frame_.right) - v * vec3(frame_.up));
    const std::optional<RayHit> hit = mesh_.castFronts(vec3(frame_.eye), way, kFar);
    if (!hit) return sky_ ? skyLight(way, to_sun_) : vec3(0);
    const vec3 facet = glm::normalize(hit->facing);
    vec3 normal = (1 - hit->u - hit->v) * mesh_.vertex(hit->triangle, 0).normal +
                  hit->u * mesh_.vertex(hit->triangle, 1).normal + hit->v * mesh_.vertex(hit->triangle, 2).normal;
    normal = glm::length(normal) > 0.1f ? glm::normalize(normal) : facet;
    const vec3 place = vec3(frame_.eye) + hit->distance * way + facet * (1e-3f + 1e-3f * hit->distance);
    const size_t index = std::min<size_t>(mesh_.vertex(hit->triangle, 0).material, scene_.materials.size() - 1);
    const vec3 colour = scene_.materials[index].colour * lightOn(place, normal, openness(place, normal, x, y));
    if (!sky_) return colour;
    return mix(skyLight(way, to_sun_), colour, std::exp(-hit->distance / scene_.fog_distance));
  }

  float exposure() const { return frame_.pattern_offset.w; }

 private:
  vec3 lightOn(vec3 place, vec3 normal, float open) const {
    if (sky_) {
      const vec3 sky = 0.5f * (skyLight(vec3(0, 1, 0), to_sun_) + skyLight(normal, to_sun_));
      const float facing = dot(normal, to_sun_);
      const bool lit = facing > 0 && mesh_.isFree(place, to_sun_, kFar);
      return open * sky + (lit ? facing * sunLight() : vec3(0));
    }
    vec3 sum(open * std::max(frame_.sun.w, 0.02f));
    for (uint32_t i = 0; i < frame_.counts.x; ++i) {
      const vec3 away = vec3(frame_.lamp_position[i]) - place;
      const float distance = std::max(glm::length(away), 1e-4f), facing = dot(normal, away) / distance;
      float fall = lampFall(distance, frame_.lamp_position[i].w);
      if (i == 0) fall *= lampBeam(-dot(away, vec3(frame_.forward)) / distance);
      if (facing * fall <= 0 || !mesh_.isFree(place, away, 0.98f)) continue;
      sum += vec3(frame_.lamp_colour[i]) * (fall * facing);
    }
    return sum;
  }

  float openness(vec3 place, vec3 normal, int x, int y) const {
    UnitPoints points(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 0);
    int open = 0;
    for (int i = 0; i < kNearRays; ++i)
      open += mesh_.isFree(place, cosineDirection(normal, points.next()), sky_ ? 30.0f : 4.0f);
    return 0.25f + 0.75f * static_cast<float>(open) / kNearRays;
  }

  const RenderScene& scene_;
  const RenderFrame frame_;
  const RayCaster& mesh_;
  const vec3 to_sun_;
  const bool sky_;
};

}  // namespace

Result<Image> sketch(const RenderScene& scene, const RayCaster& mesh, JobSystem& jobs) {
  if (auto checked = checkCamera(scene.camera); !checked) return checked.error();
  if (scene.materials.empty()) return Error{Code::invalid_argument, "a scene needs at least one material"};
  if (scene.lamps.size() > kMaxLamps)
    return Error{Code::invalid_argument, "a scene may have at most " + std::to_string(kMaxLamps) + " lamps"};
  try {
    const Sketch picture(scene, mesh);
    const int width = scene.camera.width, height = scene.camera.height;
    std::vector<vec3> colours(static_cast<size_t>(width) * static_cast<size_t>(height));
    parallelFor(jobs, static_cast<size_t>(height), [&](size_t y) {
      for (int x = 0; x < width; ++x)
        colours[y * static_cast<size_t>(width) + static_cast<size_t>(x)] = picture.at(x, static_cast<int>(y));
    });
    // As in the final picture, the exposure adapts to the geometric mean of the brightness.
    BrightnessTally tally;
    for (const vec3& colour : colours) {
      const float light = dot(colour, vec3(0.2126f, 0.7152f, 0.0722f));
      if (light > 0) tally.add(light);
    }
    const float mean = tally.mean() > 0 ? tally.mean() : 1.0f;
    const float gain = picture.exposure() * std::clamp(std::pow(0.18f / mean, 0.6f), 0.5f, 4.0f);
    Image image;
    image.width = width;
    image.height = height;
    image.rgba.reserve(4 * colours.size());
    for (const vec3& colour : colours) {
      for (int channel = 0; channel < 3; ++channel) {
        // Narkowicz's approximation of the ACES filmic curve, which the shaders use too.
        const float c = 0.8f * gain * colour[channel];
        const float toned = std::clamp(c * (2.51f * c + 0.03f) / (c * (2.43f * c + 0.59f) + 0.14f), 0.0f, 1.0f);
        image.rgba.push_back(static_cast<uint8_t>(encodedSrgb(toned) * 255 + 0.5f));
      }
      image.rgba.push_back(255);
    }
    return image;
  } catch (const std::bad_alloc&) {
    return Error{Code::out_of_memory, "out of memory while sketching a picture"};
  }
}

}  // namespace sgm
