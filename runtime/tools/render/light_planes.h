#pragma once
// The light that arrives at the visible surface of each pixel, computed on the CPU by tracing rays. Afterwards, the
// shader shaders/render/shade.comp computes how much of this light the surface's material reflects to the eye.

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
  /// One byte for each lamp, the headlamp first: the share of its light that reaches the place, in 255ths. Under a sky,
  /// the first byte is for the sun.
  uint32_t open[2] = {0, 0};
  /// Four half floats. The first three: red, green and blue of the light that a mirror at the place would reflect. The
  /// fourth: on water, its depth in metres; on other surfaces, the negative wetness, 0..-1; -2 if there is no surface.
  uint32_t mirror[2] = {0, kNothingMet};

  static constexpr uint32_t kNothingMet = 0xC0000000u;  ///< value of mirror[1] whose upper half float is -2: no surface
};

struct SoftLight {
  glm::vec4 light{0};  ///< rgb: mean radiance from the sky and other surfaces, weighted by the cosine to the normal
  glm::vec4 lean{0};   ///< xyz: mean direction of the light, short if light comes evenly from all sides
  /// Exposure of the place to weather, each 0..1. x: share of directions with near surroundings; y: 1 right below a
  /// ledge that keeps rain off, less further below; z: 1 at the foot of a wall, where rain splashes from the ground,
  /// less further up. All are 0 in caves.
  glm::vec4 lie{0};
};

/// The result of light tracing: a DirectLight for each pixel, and a SoftLight for each square of kSoftPixels *
/// kSoftPixels pixels, computed at the square's first pixel.
struct LightPlanes {
  uint32_t width = 0, height = 0;
  uint32_t soft_width = 0, soft_height = 0;
  std::vector<DirectLight> direct;
  std::vector<SoftLight> soft;
  /// The light of the clouds between the eye and the surface of each pixel; empty if there are no clouds.
  std::vector<VapourLight> vapour;
  /// Geometric mean of the brightness of all visible surfaces, clouds excluded; 0 if none is visible.
  float brightness = 0;
  float lit = 0;        ///< geometric mean of the light that falls on the surfaces, regardless of their colours
  float highlight = 0;  ///< 95th percentile of the surfaces' brightness; 0 if no surface is visible
};

inline constexpr uint32_t kSoftPixels = 2;

/// Computes the light of a picture by tracing rays over the scene's mesh. The same scene gives the same planes.
/// Contract: the scene is checked, and frame belongs to it. Errors: out_of_memory; cancelled if scene.go_on returns
/// false.
Result<LightPlanes> traceLight(const RenderScene& scene, const RenderFrame& frame, JobSystem& jobs);

}  // namespace sgm
