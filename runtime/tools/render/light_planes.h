#pragma once
// Light that reaches what each pixel sees, without the light that its material adds or takes.

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
      0, 0};  ///< a byte for each lamp, the headlamp first; under a sky the first is the sun's: 255 all of it
  /// Halves: what a mirror there shows, red, green, blue; then in water how deep it is, metres, elsewhere how wet,
  /// 0..-1; -2 where no surface was met.
  uint32_t mirror[2] = {0, kNothingMet};

  static constexpr uint32_t kNothingMet = 0xC0000000u;  ///< -2 as a half: no surface was met here
};

struct SoftLight {
  glm::vec4 light{0};  ///< rgb: mean radiance that comes from the sky and from other surfaces, weighed by the cosine
  glm::vec4 lean{0};   ///< xyz: mean direction that it comes from, the shorter the more evenly it comes
  /// How the place lies, for what weather does there, each 0..1: x: how much of what is around is near; y: a ledge over
  /// it keeps rain off, 1 just below the ledge; z: what rain splashes from lies under it, 1 at its foot. All 0 in
  /// caves.
  glm::vec4 lie{0};
};

/// One DirectLight for each pixel, one SoftLight for each square of kSoftPixels; both of the square's first sample.
struct LightPlanes {
  uint32_t width = 0, height = 0;
  uint32_t soft_width = 0, soft_height = 0;
  std::vector<DirectLight> direct;
  std::vector<SoftLight> soft;
  std::vector<VapourLight> vapour;  ///< one for each pixel, before what else is seen there; none without clouds
  /// Logarithmic mean of the brightness of all surfaces in sight; 0 if no surface is. Clouds have none.
  float brightness = 0;
  float lit = 0;        ///< the same, as if all surfaces were white
  float highlight = 0;  ///< so bright or brighter are the brightest twentieth; 0 if no surface is in sight
};

inline constexpr uint32_t kSoftPixels = 2;

/// Traces rays over the scene's mesh. The same scene gives the same planes. scene must have been checked, and frame be
/// its own. Errors: out_of_memory; cancelled, where scene.go_on says so.
Result<LightPlanes> traceLight(const RenderScene& scene, const Frame& frame, JobSystem& jobs);

}  // namespace sgm
