#pragma once
// A scene with a volume of fog: density values, optical properties, light and a camera.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "tools/render/image.h"
#include "tools/render/scene.h"

namespace sgm {

/// Optical properties of the fog.
struct VolumeMedium {
  /// Extinction coefficient per metre at density 1, at least 0. Its reciprocal is the mean free path.
  float extinction = 0.05f;
  float albedo = 1.0f;   ///< share of the extinguished light that is scattered rather than absorbed, 0..1
  float forward = 0.8f;  ///< mean cosine of the scattering angle (g of the phase function), above -1 and below 1
  /// Number of octaves that approximate multiple scattering, 1..32; 1: single scattering only.
  uint32_t octaves = 5;
};

struct VolumeScene {
  std::span<const uint8_t> density;  ///< density values in 255ths; x varies fastest, then y, then z
  glm::uvec3 size{0};                ///< number of points along each axis, at least 2
  glm::vec3 corner{0};               ///< position of the first point, metres from the scene's origin
  float spacing = 1;                 ///< metres, above 0
  VolumeMedium medium;
  RenderCamera camera;
  glm::vec3 sun_direction{-0.62f, 0.62f, 0.48f};  ///< direction to the sun
  glm::vec3 sun_light{26.0f, 24.2f, 21.5f};       ///< irradiance on a surface that faces the sun
  glm::vec3 sky_light{0.34f, 0.45f, 0.64f};       ///< radiance from the sky above
  glm::vec3 ground_light{0.10f, 0.11f, 0.125f};   ///< radiance from the ground below
  float fog_distance = 10000;                     ///< metres; distance over which haze extinguishes about two thirds of
                                                  ///< the light (as RenderScene::fog_distance)
  float exposure = 0.85f;
  int supersample = 2;  ///< rays along each side of a pixel, 1..3
};

struct VolumePicture {
  Image image;  ///< picture of the fog in front of the sky
  /// For each pixel, the fog's layer, which an engine would blend over its own picture. rgb: light from the fog that
  /// reaches the eye; alpha: transmittance of the fog.
  std::vector<glm::vec4> light;
};

}  // namespace sgm
