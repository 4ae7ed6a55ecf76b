#pragma once
// Draws clouds as a participating medium: the material `cloud` under a sky, with the mesh as the boundary of the
// medium.

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "tools/render/frame.h"
#include "tools/render/vapour_density.h"

namespace sgm {

/// A scene's triangles, divided into bodies, whose surface is drawn, and clouds under a sky, whose surface is not
/// drawn. Clouds with texture coordinates count as bodies, so that the coordinates are visible.
struct SceneParts {
  std::vector<uint32_t> bodies, clouds;
};
SceneParts partsOf(const RenderScene& scene);

/// The clouds along a ray from the eye, in the layout of shaders/render/traced.glsl.
struct VapourLight {
  uint32_t light[2] = {0, 0x3C000000u};  ///< half floats: red, green, blue, transmittance
  float distance = 0;                    ///< mean distance in metres of the visible part of the clouds
  float reserved = 0;
};

/// Clouds and the light in them: sunlight, scattered once and repeatedly; light of the sky above and of the land below.
class Vapour {
 public:
  /// `clouds` must not be empty. Error: out_of_memory.
  static Result<Vapour> over(const RenderScene& scene, const Frame& frame, std::span<const uint32_t> clouds,
                             JobSystem& jobs);

  /// Marches along a ray of unit direction from the eye to a distance in metres. x, y: the pixel, which seeds the
  /// random offset of the ray's samples.
  VapourLight march(glm::vec3 from, glm::vec3 direction, float end, uint32_t x, uint32_t y) const;
  /// The share of sunlight that reaches a place through the clouds.
  float sunThrough(glm::vec3 position) const;
  /// An approximation of the sky's radiance through the clouds, for diffuse light.
  glm::vec3 skyThrough(glm::vec3 position, glm::vec3 direction, glm::vec3 sky) const;

 private:
  /// The medium of a cloud: water droplets, or the thin ice of cirrus.
  struct Stuff {
    glm::vec3 colour;
    float density, puffs;  ///< 0..1: factor of the extinction, and strength of the puffs at the boundary
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
  /// For each lattice point: optical depth towards the sun; unobstructed shares upwards, downwards and on all sides.
  std::vector<glm::vec4> lit_;
  std::vector<uint8_t> detail_;
  std::vector<Stuff> stuffs_;  ///< indexed by material
  glm::vec3 to_sun_, sun_light_, sky_light_, ground_light_, pattern_offset_;
  float sample_angle_;
};

}  // namespace sgm
