#pragma once
// The light that reaches the surface in each pixel. It does not depend on how much light the material there emits or
// absorbs.

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "base/jobs.h"
#include "base/result.h"
#include "tools/render/frame.h"
#include "tools/render/vapour.h"

namespace sgm {

/// Direct light and reflection of a pixel, in the layout of shaders/render/traced.glsl.
struct DirectLight {
  /// A byte for each lamp, the headlamp first: 255 if all of its light reaches the place. Under a sky the first byte is
  /// the sun's.
  uint32_t open[2] = {0, 0};
  /// Four half floats. The first three: red, green and blue of the light that a mirror there would reflect. The fourth:
  /// depth of water in metres if there is water, otherwise the negative wetness, 0..-1; -2 if there is no surface.
  uint32_t mirror[2] = {0, kNothingMet};

  static constexpr uint32_t kNothingMet = 0xC0000000u;  ///< the fourth half is -2: no surface
};

struct SoftLight {
  glm::vec4 light{0};  ///< rgb: mean radiance from the sky and other surfaces, weighted by the cosine
  glm::vec4 lean{0};   ///< xyz: mean direction of the light; the more even the light, the shorter the vector
  /// Exposure of the place to weather, each 0..1. x: share of directions with near surroundings; y: 1 just below a
  /// ledge that keeps rain off, less further below; z: 1 at the foot of a wall where the ground splashes rain, less
  /// above. All are 0 in caves.
  glm::vec4 lie{0};
};

/// A DirectLight for each pixel, and a SoftLight for each square of kSoftPixels pixels, at the square's first sample.
struct LightPlanes {
  uint32_t width = 0, height = 0;
  uint32_t soft_width = 0, soft_height = 0;
  std::vector<DirectLight> direct;
  std::vector<SoftLight> soft;
  /// One for each pixel, for the clouds in front of its surface; empty if there are no clouds.
  std::vector<VapourLight> vapour;
  /// Geometric mean of the brightness of all visible surfaces without clouds; 0 if none is visible.
  float brightness = 0;
  float lit = 0;        ///< geometric mean of the brightness that the surfaces would have if all were white
  float highlight = 0;  ///< brightness that the brightest twentieth of the surfaces reaches; 0 if no surface is visible
};

inline constexpr uint32_t kSoftPixels = 2;

/// Traces rays over the scene's mesh. The same scene gives the same planes. Contract: scene is checked, and frame
/// belongs to it. Errors: out_of_memory; cancelled if scene.go_on returns false.
Result<LightPlanes> traceLight(const RenderScene& scene, const Frame& frame, JobSystem& jobs);

}  // namespace sgm
