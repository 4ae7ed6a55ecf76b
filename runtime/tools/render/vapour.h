#pragma once
// Draws clouds as a participating medium. The clouds are the parts of the mesh with the material `cloud`, under a sky.

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "tools/render/frame.h"
#include "tools/render/vapour_density.h"

namespace sgm {

/// The indices of a scene's triangles, split into bodies, whose surfaces are drawn, and clouds, which are drawn as a
/// medium. Without a sky there are no clouds. Clouds with texture coordinates count as bodies, so that the coordinates
/// are visible.
struct SceneParts {
  std::vector<uint32_t> bodies, clouds;
};
SceneParts partsOf(const RenderScene& scene);

/// The light of the clouds along a ray from the eye, in the layout of shaders/render/traced.glsl.
struct VapourLight {
  uint32_t light[2] = {0, 0x3C000000u};  ///< four half floats: red, green, blue and transmittance
  float distance = 0;                    ///< mean distance in metres of the visible part of the clouds
  float reserved = 0;
};

/// Clouds and their precomputed light: sunlight after single and multiple scattering, and light from the sky above and
/// the land below.
class Vapour {
 public:
  /// Contract: `clouds`, indices of the clouds' triangles, is not empty. Error: out_of_memory.
  static Result<Vapour> over(const RenderScene& scene, const RenderFrame& frame, std::span<const uint32_t> clouds,
                             JobSystem& jobs);

  /// Marches along a ray of unit direction from the eye up to the distance `end`, in metres. x, y: the pixel, which
  /// seeds the random offset of the samples.
  VapourLight march(glm::vec3 from, glm::vec3 direction, float end, uint32_t x, uint32_t y) const;
  /// The share of sunlight that reaches a position through the clouds.
  float sunThrough(glm::vec3 position) const;
  /// Approximates the radiance of the sky, dimmed and lit by clouds in front of it, for diffuse light.
  glm::vec3 skyThrough(glm::vec3 position, glm::vec3 direction, glm::vec3 sky) const;

 private:
  /// Properties of a cloud material, for example of dense water droplets or of thin cirrus.
  struct Stuff {
    glm::vec3 colour;
    /// density: factor of the extinction; puffs: strength of the noise at the cloud's boundary; each 0..1
    float density, puffs;
  };

  Vapour(const RenderScene& scene, const RenderFrame& frame, VapourDensity density);
  void light(JobSystem& jobs);
  const Stuff& stuffAt(glm::vec3 place) const;
  float densityAt(glm::vec3 place, float footprint) const;
  float opticalDepth(glm::vec3 place, glm::vec3 direction) const;
  glm::vec4 litAt(glm::vec3 place) const;
  glm::vec3 sourceAt(glm::vec3 place, float cosine, float footprint) const;

  VapourDensity density_;
  VapourLattice light_lattice_;
  /// For each point of the light lattice: optical depth towards the sun, then the mean share of light that arrives from
  /// above, from below and from all sides.
  std::vector<glm::vec4> lit_;
  std::vector<Stuff> stuffs_;  ///< properties of each material, indexed by material
  glm::vec3 to_sun_, sun_light_, sky_light_, ground_light_, pattern_offset_;
  float sample_angle_;
};

}  // namespace sgm
