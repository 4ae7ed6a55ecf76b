#pragma once
// Clouds as light sees them: the material `cloud` under a sky is a medium, of which the mesh is the outline.

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "tools/render/frame.h"
#include "tools/render/vapour_density.h"

namespace sgm {

/// The triangles of a scene: of bodies, which have a surface, and of clouds under a sky, which have none. Clouds that
/// are drawn with texture coordinates keep their surface, for that is what the coordinates lie on.
struct SceneParts {
  std::vector<uint32_t> bodies, clouds;
};
SceneParts partsOf(const RenderScene& scene);

/// What a ray from the eye meets of clouds, laid out as shaders/render/traced.glsl reads it.
struct VapourLight {
  uint32_t light[2] = {0, 0x3C000000u};  ///< halves: red, green, blue, the share of what is behind that still shows
  float distance = 0;                    ///< metres to what is seen of it, on a mean
  float reserved = 0;
};

/// Clouds with the light in them: of the sun, scattered once and often, of the sky above and of the land below.
class Vapour {
 public:
  /// The triangles of `clouds` are some. Error: out_of_memory.
  static Result<Vapour> over(const RenderScene& scene, const Frame& frame, std::span<const uint32_t> clouds,
                             JobSystem& jobs);

  /// Along a ray of unit length direction from the eye to a distance in metres. x, y: the pixel, which tells it from
  /// other rays.
  VapourLight march(glm::vec3 from, glm::vec3 direction, float end, uint32_t x, uint32_t y) const;
  /// The share of the sun's light that comes through to a place.
  float sunThrough(glm::vec3 position) const;
  /// What is seen of a sky of some light through the clouds, roughly, for light that comes from many sides.
  glm::vec3 skyThrough(glm::vec3 position, glm::vec3 direction, glm::vec3 sky) const;

 private:
  /// What a cloud is made of: droplets, or the thin ice of cirrus.
  struct Stuff {
    glm::vec3 colour;
    float density, puffs;  ///< 0..1: of the light that is lost on the way, and how far puffs move the outline
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
  std::vector<glm::vec4> lit_;  ///< by point: depth towards the sun, open shares upwards, downwards and on all sides
  std::vector<uint8_t> detail_;
  std::vector<Stuff> stuffs_;  ///< by material
  glm::vec3 to_sun_, sun_light_, sky_light_, ground_light_, pattern_offset_;
  float sample_angle_;
};

}  // namespace sgm
