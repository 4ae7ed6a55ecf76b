#pragma once
// Light that reaches each pixel's surface, without what the material emits or absorbs.

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "base/jobs.h"
#include "base/result.h"
#include "tools/render/frame.h"
#include "tools/render/vapour.h"

namespace sgm {

/// Laid out as shaders/render/traced.glsl reads it.
struct DirectLight {
  uint32_t open[2] = {
      0, 0};  ///< a byte for each lamp, the headlamp first; under a sky the first is the sun's: 255 is full light
  /// Halves: red, green and blue in a mirror there; then the depth of water, metres, or elsewhere the wetness, 0..-1;
  /// -2 if there is no surface.
  uint32_t mirror[2] = {0, kNothingMet};

  static constexpr uint32_t kNothingMet = 0xC0000000u;  ///< -2 as a half: no surface
};

struct SoftLight {
  glm::vec4 light{0};  ///< rgb: mean radiance from the sky and other surfaces, weighted by the cosine
  glm::vec4 lean{0};   ///< xyz: mean direction of the light, shorter for more even light
  /// Exposure of the place to weather, each 0..1: x: share of near surroundings; y: a ledge above keeps rain off, 1
  /// just below it; z: ground below splashes rain, 1 at its foot. All 0 in caves.
  glm::vec4 lie{0};
};

/// A DirectLight for each pixel, and a SoftLight for each square of kSoftPixels; both at the square's first sample.
struct LightPlanes {
  uint32_t width = 0, height = 0;
  uint32_t soft_width = 0, soft_height = 0;
  std::vector<DirectLight> direct;
  std::vector<SoftLight> soft;
  std::vector<VapourLight> vapour;  ///< one for each pixel, in front of the surface; empty without clouds
  /// Logarithmic mean of the brightness of all visible surfaces; 0 if none is visible. Clouds do not count.
  float brightness = 0;
  float lit = 0;        ///< the same, as if all surfaces were white
  float highlight = 0;  ///< brightness of the brightest twentieth or more; 0 if no surface is visible
};

inline constexpr uint32_t kSoftPixels = 2;

/// Traces rays over the scene's mesh. The same scene gives the same planes. scene must be checked, and frame belong to
/// it. Errors: out_of_memory; cancelled, by scene.go_on.
Result<LightPlanes> traceLight(const RenderScene& scene, const Frame& frame, JobSystem& jobs);

}  // namespace sgm
