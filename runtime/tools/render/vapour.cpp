#include "tools/render/vapour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>
#include <new>
#include <utility>

#include "tools/render/illuminated.h"
#include "tools/render/puff_noise.h"
#include "tools/render/sampling.h"

namespace sgm {
namespace {

constexpr float kPi = 3.14159265f;
constexpr int kCoarser = 2;  // spacing of the light lattice in cells of the density lattice
constexpr float kStep = 0.5f, kOpaque = 0.004f;
constexpr float kForward = 0.82f;  // mean cosine of the scattering angle of droplets (g)
constexpr int kOctaves = 7;
constexpr float kKept = 0.82f;  // scales the sum over octaves, so that a cloud emits no more light than it receives
/// kThinnest: there is no cloud where the smoothed outline is below this value. kErosion: noise erodes the boundary by
/// up to this amount. kEdge: width over which the density rises at the boundary.
constexpr float kThinnest = 0.05f, kErosion = 0.92f, kEdge = 0.24f;
// Maximum of the noise in creases between puffs: higher values would look like dark dots where three puffs meet.
constexpr float kDeepest = 0.78f;
constexpr float kPuff = 9;  // period of the largest puffs, in cells

vec3 withoutZeros(vec3 d) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(d[axis]) < 1e-7f) d[axis] = 1e-7f;
  return d;
}

/// Henyey-Greenstein phase function (1941). cosine: cosine of the scattering angle; g: mean of that cosine.
float phase(float cosine, float g) {
  const float s = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * kPi * s * std::sqrt(s));
}

/// Mean radiance over the upper hemisphere (up = 1: sky) or the lower hemisphere (up = -1: land).
vec3 meanLight(vec3 to_sun, float up) {
  constexpr int kRings = 8, kAround = 16;
  vec3 sum(0);
  for (int ring = 0; ring < kRings; ++ring) {
    const float y = (static_cast<float>(ring) + 0.5f) / kRings, r = std::sqrt(1 - y * y);
    for (int i = 0; i < kAround; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / kAround;
      sum += skyLight({r * std::cos(angle), up * y, r * std::sin(angle)}, to_sun);
    }
  }
  return sum / static_cast<float>(kRings * kAround);
}

/// Makes light whiter: high up, sunlight is whiter than on the ground, and clouds scatter light onto each other.
vec3 whitened(vec3 light) { return mix(light, vec3(dot(light, vec3(0.2126f, 0.7152f, 0.0722f))), 0.55f); }

}  // namespace

SceneParts partsOf(const RenderScene& scene) {
  SceneParts parts;
  const bool sky = scene.background == Background::sky;
  for (size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
    const RenderVertex& first = scene.vertices[scene.indices[i]];
    const size_t material = std::min<size_t>(first.material, scene.materials.size() - 1);
    const bool charted = first.texture != scene.vertices[scene.indices[i + 1]].texture ||
                         first.texture != scene.vertices[scene.indices[i + 2]].texture;
    const bool cloud = sky && !charted && scene.materials[material].pattern == SurfacePattern::cloud;
    std::vector<uint32_t>& part = cloud ? parts.clouds : parts.bodies;
    part.insert(part.end(), scene.indices.begin() + static_cast<std::ptrdiff_t>(i),
                scene.indices.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  return parts;
}

Vapour::Vapour(const RenderScene& scene, const RenderFrame& frame, VapourDensity density)
    : density_(std::move(density)),
      to_sun_(frame.sun),
      sun_light_(whitened(sunLight())),
      sky_light_(glm::mix(meanLight(to_sun_, 1), whitened(meanLight(to_sun_, 1)), 0.6f)),
      ground_light_(whitened(meanLight(to_sun_, -1))),
      pattern_offset_(frame.pattern_offset),
      sample_angle_(frame.eye.w * static_cast<float>(frame.size.z)) {
  for (const RenderMaterial& material : scene.materials)
    stuffs_.push_back({material.colour, material.roughness * material.roughness, std::min(1.0f, material.relief)});
  const VapourLattice& fine = density_.lattice();
  light_lattice_.corner = fine.corner;
  light_lattice_.spacing = fine.spacing * kCoarser;
  light_lattice_.size = (fine.size + kCoarser - 2) / kCoarser + 1;
}

Result<Vapour> Vapour::over(const RenderScene& scene, const RenderFrame& frame, std::span<const uint32_t> clouds,
                            JobSystem& jobs) {
  try {
    const Result<RayCaster> outline = RayCaster::over(scene.vertices, clouds, Gaps::closed);
    if (!outline) return outline.error();
    Vapour vapour(scene, frame, VapourDensity(*outline, jobs));
    vapour.light(jobs);
    return vapour;
  } catch (const std::bad_alloc&) {
    return Error{Code::out_of_memory, "out of memory while lighting clouds"};
  }
}

const Vapour::Stuff& Vapour::stuffAt(vec3 place) const {
  return stuffs_[std::min<size_t>(density_.materialAt(place), stuffs_.size() - 1)];
}

/// The optical depth from a place along a direction, integrated in steps that grow with the distance.
float Vapour::opticalDepth(vec3 place, vec3 direction) const {
  const vec3 d = withoutZeros(direction);
  const float end = density_.crossing(place, d).y;
  float depth = 0, step = 1;
  for (float t = 0.25f; t < end;) {
    if (const float ahead = density_.emptyAhead(place, d, t); ahead > 0) {
      t += ahead;
      continue;
    }
    const vec3 middle = place + d * (t + 0.5f * step);
    depth += stuffAt(middle).density * density_.plainAt(middle) * step;
    t += step;
    step = std::min(1.25f * step, 8.0f);
  }
  return depth * density_.lattice().spacing / density_.meanFreePath();
}

void Vapour::light(JobSystem& jobs) {
  lit_.assign(light_lattice_.count(), glm::vec4(0));
  const glm::ivec3 size = light_lattice_.size;
  parallelFor(jobs, size_t(size.z), [&](size_t z) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const glm::ivec3 point = glm::ivec3(x, y, z) * kCoarser;
        // `seen`: there is density near this lattice point. Light is interpolated between lattice points, so it is
        // needed only at points near density.
        bool seen = false;
        for (int i = 0; i < 8 && !seen; ++i) {
          const glm::ivec3 away = (glm::ivec3(i & 1, i >> 1 & 1, i >> 2) * 2 - 1) * kCoarser;
          seen = !density_.isEmptyBrick(
              glm::clamp((point + away) / VapourDensity::kBrick, glm::ivec3(0), density_.bricks() - 1));
        }
        if (!seen) continue;
        const vec3 place(point);
        float up = 0, down = 0, free = 0;
        const auto look = [&](vec3 direction) {
          const float depth = opticalDepth(place, direction);
          (direction.y > 0 ? up : down) += std::exp(-0.25f * depth);
          free += std::exp(-0.5f * depth);
        };
        look({0, 1, 0});
        look({0.8f, 0.6f, 0});
        look({-0.4f, 0.6f, 0.693f});
        look({-0.4f, 0.6f, -0.693f});
        look({0, -1, 0});
        look({0.4f, -0.6f, 0.693f});
        look({0.4f, -0.6f, -0.693f});
        look({-0.8f, -0.6f, 0});
        lit_[light_lattice_.at(x, y, int(z))] = {opticalDepth(place, to_sun_), up / 4, down / 4, free / 8};
      }
    }
  });
}

// The density at a place in detail: noise puffs displace the boundary. footprint: size in cells below which puffs are
// omitted.
float Vapour::densityAt(vec3 place, float footprint) const {
  const Stuff& stuff = stuffAt(place);
  const float outline = density_.outlineAt(place);
  if (outline <= kThinnest) return 0;
  const float spacing = density_.lattice().spacing;
  const vec3 position = density_.lattice().corner + place * spacing + pattern_offset_;
  const float hollow = std::min(puffHollows(position, kPuff * spacing, footprint * spacing), kDeepest);
  const float within = std::clamp((outline - kThinnest - kErosion * stuff.puffs * hollow) / kEdge, 0.0f, 1.0f);
  return stuff.density * within * within;
}

glm::vec4 Vapour::litAt(vec3 place) const {
  const vec3 held = glm::clamp(place / float(kCoarser), vec3(0), vec3(light_lattice_.size - 1) - 1e-3f);
  const glm::ivec3 i(held);
  const vec3 f = held - vec3(i);
  const glm::vec4* p = lit_.data() + light_lattice_.at(i.x, i.y, i.z);
  const size_t row = size_t(light_lattice_.size.x), slice = row * size_t(light_lattice_.size.y);
  const auto along = [&](size_t off) { return glm::mix(p[off], p[off + 1], f.x); };
  return glm::mix(glm::mix(along(0), along(row), f.y), glm::mix(along(slice), along(slice + row), f.y), f.z);
}

/// Radiance that the cloud at a place scatters into a ray. Sunlight is a sum over octaves of scattering; the first
/// octave is single scattering. Light that is scattered repeatedly goes farther and loses its direction. Each further
/// octave therefore has smaller extinction and a smaller mean cosine than the previous one (Wrenninge, Kulla and
/// Lundqvist 2013, "Oz: the great and volumetric"). The energy of an octave is the part of the previous octave's energy
/// that does not escape from the cloud.
vec3 Vapour::sourceAt(vec3 place, float cosine, float footprint) const {
  const glm::vec4 lit = litAt(place);
  // Close to the place, sample the density of the puffs towards the sun directly: the light lattice is too coarse to
  // resolve the puffs.
  constexpr std::array kNear{0.6f, 1.9f, 4.0f}, kLong{1.2f, 1.5f, 2.8f};
  float near = 0;
  for (size_t i = 0; i < kNear.size(); ++i)
    near += kLong[i] * densityAt(place + to_sun_ * kNear[i], std::max(footprint, 0.5f * kNear[i]));
  const float depth =
      near * density_.lattice().spacing / density_.meanFreePath() + litAt(place + to_sun_ * (1.2f + 1.5f + 2.8f)).x;
  const float again = 0.92f * (1 - lit.w * lit.w);
  float sum = 0, share = 1, lost = 1, g = kForward;
  for (int octave = 0; octave < kOctaves; ++octave) {
    sum += share * phase(cosine, g) * std::exp(-depth * lost);
    share *= again;
    lost *= 0.57f;
    g *= 0.5f;
  }
  return sun_light_ * (kPi * kKept * sum) + 0.58f * sky_light_ * lit.y + 0.5f * ground_light_ * lit.z;
}

VapourLight Vapour::march(vec3 from, vec3 direction, float end, uint32_t x, uint32_t y) const {
  VapourLight result;
  const float spacing = density_.lattice().spacing;
  const vec3 start = density_.placeOf(from), d = withoutZeros(direction);
  const glm::vec2 ends = density_.crossing(start, d);
  const float last = std::min(ends.y, end / spacing), cosine = dot(direction, to_sun_);
  const float jitter = UnitPoints(x, y, 96).next().x, paths = spacing / density_.meanFreePath();
  float through = 1, far = 0;
  vec3 sum(0);
  for (float t = std::max(ends.x, 0.0f) + 1e-3f; t < last && through > kOpaque;) {
    if (const float ahead = density_.emptyAhead(start, d, t); ahead > 0) {
      t += ahead;
      continue;
    }
    const float footprint = t * sample_angle_, step = std::min(std::max(kStep, footprint), last - t);
    const vec3 place = start + d * (t + jitter * step);
    if (const float density = densityAt(place, footprint); density > 0) {
      const float passed = std::exp(-density * step * paths), seen = through * (1 - passed);
      sum += seen * stuffAt(place).colour * sourceAt(place, cosine, footprint);
      far += seen * t * spacing;
      through *= passed;
    }
    t += std::max(step, 1e-3f);
  }
  if (through >= 1) return result;
  result.distance = far / (1 - through);
  if (through <= kOpaque) through = 0;
  sum = glm::min(sum, vec3(6e4f));
  result.light[0] = glm::packHalf2x16({sum.r, sum.g});
  result.light[1] = glm::packHalf2x16({sum.b, through});
  return result;
}

float Vapour::sunThrough(vec3 position) const {
  const vec3 place = density_.placeOf(position), d = withoutZeros(to_sun_);
  const glm::vec2 ends = density_.crossing(place, d);
  if (ends.y <= std::max(ends.x, 0.0f)) return 1;
  const float depth = opticalDepth(place + d * std::max(ends.x, 0.0f), to_sun_);
  // The second term stands for forward-scattered light, which still arrives behind thick clouds.
  return 0.75f * std::exp(-depth) + 0.25f / (1 + 0.25f * depth);
}

vec3 Vapour::skyThrough(vec3 position, vec3 direction, vec3 sky) const {
  const vec3 place = density_.placeOf(position), d = withoutZeros(direction);
  const glm::vec2 ends = density_.crossing(place, d);
  if (ends.y <= std::max(ends.x, 0.0f)) return sky;
  const float through = std::exp(-opticalDepth(place + d * std::max(ends.x, 0.0f), direction));
  return glm::mix(0.5f * (sky_light_ + ground_light_) + 0.2f * sunLight(), sky, through);
}

}  // namespace sgm
