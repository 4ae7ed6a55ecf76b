#pragma once
// A scene of fog: a volume of density values, the optical properties of the fog, the light and a camera.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "tools/render/image.h"
#include "tools/render/scene.h"

namespace sgm {

/// Optical properties of the fog.
struct VolumeMedium {
  /// Extinction coefficient at density 1, per metre, at least 0; the mean free path is 1 / extinction.
  float extinction = 0.05f;
  float albedo = 1.0f;   ///< share of the extinguished light that is scattered, not absorbed, 0 to 1
  float forward = 0.8f;  ///< mean cosine of the scattering angle (g), above -1 and below 1
  /// Number of octaves that approximate multiple scattering, up to 32; 1: single scattering only.
  uint32_t octaves = 5;
};

struct VolumeScene {
  std::span<const uint8_t> density;  ///< density values in 255ths; x varies fastest, then y, then z
  glm::uvec3 size{0};                ///< number of points on each axis, at least 2
  glm::vec3 corner{0};               ///< position of the first point, metres from the scene's origin
  float spacing = 1;                 ///< metres, above 0
  VolumeMedium medium;
  RenderCamera camera;
  glm::vec3 sun_direction{-0.62f, 0.62f, 0.48f};  ///< towards the sun
  glm::vec3 sun_light{26.0f, 24.2f, 21.5f};       ///< irradiance on a surface that faces the sun
  glm::vec3 sky_light{0.34f, 0.45f, 0.64f};       ///< radiance from the sky above
  glm::vec3 ground_light{0.10f, 0.11f, 0.125f};   ///< radiance from the ground below
  float fog_distance = 10000;                     ///< as RenderScene::fog_distance
  float exposure = 0.85f;
  int supersample = 2;  ///< rays on each side of a pixel, 1..3
};

struct VolumePicture {
  Image image;  ///< the fog in front of the sky
  /// For each pixel, the layer that an engine would blend over its scene: rgb: light that reaches the eye; alpha:
  /// transmittance of the volume.
  std::vector<glm::vec4> light;
};

}  // namespace sgm
