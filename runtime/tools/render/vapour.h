#pragma once
// Clouds as a participating medium: the material `cloud` under a sky, with the mesh as its outline.

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "tools/render/frame.h"
#include "tools/render/vapour_density.h"

namespace sgm {

/// Divides a scene's triangles into bodies, which have a surface, and clouds under a sky, which have none. Clouds drawn
/// with texture coordinates keep their surface, to show the coordinates.
struct SceneParts {
  std::vector<uint32_t> bodies, clouds;
};
SceneParts partsOf(const RenderScene& scene);

/// The clouds along a ray from the eye, laid out as in shaders/render/traced.glsl.
struct VapourLight {
  uint32_t light[2] = {0, 0x3C000000u};  ///< halves: red, green, blue, transmittance
  float distance = 0;                    ///< mean distance in metres of the visible part
  float reserved = 0;
};

/// Clouds and the light in them: of the sun, scattered once and repeatedly, of the sky above and of the land below.
class Vapour {
 public:
  /// `clouds` must not be empty. Error: out_of_memory.
  static Result<Vapour> over(const RenderScene& scene, const Frame& frame, std::span<const uint32_t> clouds,
                             JobSystem& jobs);

  /// Marches a ray of unit direction from the eye to a distance in metres. x, y: the pixel, which seeds the ray's
  /// jitter.
  VapourLight march(glm::vec3 from, glm::vec3 direction, float end, uint32_t x, uint32_t y) const;
  /// The share of sunlight that reaches a place.
  float sunThrough(glm::vec3 position) const;
  /// The radiance of the sky through the clouds, roughly, for diffuse light.
  glm::vec3 skyThrough(glm::vec3 position, glm::vec3 direction, glm::vec3 sky) const;

 private:
  /// The substance of a cloud: droplets, or thin ice of cirrus.
  struct Stuff {
    glm::vec3 colour;
    float density, puffs;  ///< 0..1: of the extinction, and of the puffs' effect on the outline
  };

  Vapour(const RenderScene& scene, const Frame& frame, VapourDensity density);
  void light(JobSystem& jobs);
  const Stuff& stuffAt(glm::vec3 place) const;
  float densityAt(glm::vec3 place, float footprint) const;
  float opticalDepth(glm::vec3 place, glm::vec3 direction) const;
  glm::vec4 litAt(glm::vec3 place) const;
  glm::vec3 sourceAt(glm::vec3 place, float cosine, float footprint) const;

  VapourDensity density_;
  Lattice light_lattice_;
  std::vector<glm::vec4> lit_;  ///< by point: depth towards the sun; open shares upwards, downwards and on all sides
  std::vector<uint8_t> detail_;
  std::vector<Stuff> stuffs_;  ///< by material
  glm::vec3 to_sun_, sun_light_, sky_light_, ground_light_, pattern_offset_;
  float sample_angle_;
};

}  // namespace sgm
