#pragma once
// A scene to draw: a mesh, its materials, lights, a background, and a camera.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/fixed.h"
#include "tools/materials/material.h"

namespace sgm {

/// A vertex: position in metres from the scene's origin; unit normal out of the solid, or zero to use the triangle's
/// own.
struct RenderVertex {
  glm::vec3 position{0};
  glm::vec3 normal{0};
  uint32_t material = 0;  ///< index into RenderScene::materials, clamped to the last one
  /// Index of a second material to blend with; as the first, the same at all corners of a triangle.
  uint32_t second = 0;
  float share = 0;  ///< share of the second material at this vertex, 0..1
  /// Texture coordinates, drawn as a checkerboard. If they are equal at all corners of a triangle, it has no texture.
  glm::vec2 texture{0};
};

struct RenderMaterial {
  SurfacePattern pattern = SurfacePattern::rock;
  glm::vec3 colour{0.42f, 0.37f, 0.31f};  ///< linear, 0..1
  float roughness = 0.75f;                ///< 0.05..1
  float relief = 1;                       ///< strength of the shading relief, 0: as smooth as the mesh
};

/// The appearance of a grammar's `mat NAME` (findLook). nullopt if the name is unknown.
std::optional<RenderMaterial> findMaterial(std::string_view name);
/// As findMaterial, but an unknown name also gets an appearance (lookOf).
RenderMaterial materialByName(std::string_view name);

/// A lamp that shines in all directions. Its light decreases with the square of the distance.
struct RenderLamp {
  glm::vec3 position{0};  ///< metres from the scene's origin
  glm::vec3 colour{1, 0.9f, 0.75f};
  float reach = 10;  ///< distance in metres at which a facing wall is well lit, above 0
};

/// A camera at `position` that looks at `target`, with Y up. Positions are metres from the scene's origin.
struct RenderCamera {
  glm::vec3 position{0};
  glm::vec3 target{0, 0, -1};
  float fov_degrees = 68;  ///< across the picture's height, 1..150
  int width = 1280;        ///< pixels, 1..kMaxPicture
  int height = 720;
};

enum class Background : uint32_t { cave, sky };

inline constexpr size_t kMaxLamps = 7;

struct RenderScene {
  std::span<const RenderVertex> vertices;
  std::span<const uint32_t> indices;  ///< three for each triangle, counter-clockwise as seen from outside the solid
  std::span<const RenderMaterial> materials;  ///< at least one
  /// World position of the scene's origin, in units: patterns are fixed to the world, wherever a picture has its
  /// origin.
  Int3 origin;
  RenderCamera camera;
  /// The lamp on the explorer's helmet, a little above and beside the camera, which points in the camera's direction.
  /// Its reach is in metres; its position is ignored.
  RenderLamp headlamp;
  std::vector<RenderLamp> lamps;  ///< lamps at fixed places, at most kMaxLamps
  float ambient = 0.012f;         ///< light from all directions, 0..1
  Background background = Background::cave;
  glm::vec3 sun_direction{-0.62f, 0.62f, 0.48f};  ///< towards the sun; used under a sky
  float fog_distance = 60;  ///< distance in metres over which haze absorbs about two thirds of the light
  float exposure = 0.85f;
  int supersample = 2;  ///< samples on each side of a pixel, 1..3
  /// Called from any thread while light is traced; false cancels the picture with Code::cancelled. May be empty.
  std::function<bool()> go_on;
};

}  // namespace sgm
