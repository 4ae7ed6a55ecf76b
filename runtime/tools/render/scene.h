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

/// A vertex of the mesh. position: metres from the scene's origin. normal: unit length, points out of the solid; or
/// zero to use the triangle's normal.
struct RenderVertex {
  glm::vec3 position{0};
  glm::vec3 normal{0};
  uint32_t material = 0;  ///< index into RenderScene::materials; larger values mean the last material
  /// Index of a second material that is blended with `material`. All corners of a triangle must have the same two
  /// materials.
  uint32_t second = 0;
  float share = 0;  ///< share of the second material at this vertex, 0..1
  /// Texture coordinates, drawn as a checkerboard. A triangle with equal coordinates at all corners has no texture.
  glm::vec2 texture{0};
};

struct RenderMaterial {
  SurfacePattern pattern = SurfacePattern::rock;
  glm::vec3 colour{0.42f, 0.37f, 0.31f};  ///< linear, 0..1
  float roughness = 0.75f;                ///< 0.05..1
  float relief = 1;                       ///< strength of the bump mapping; 0: as smooth as the mesh
};

/// The appearance of the grammar's material `mat NAME`, looked up by findLook(); nullopt if the name is unknown.
std::optional<RenderMaterial> findMaterial(std::string_view name);
/// Like findMaterial(), but an unknown name also gets an appearance, chosen by lookOf().
RenderMaterial materialByName(std::string_view name);

/// A point lamp that shines in all directions; its light decreases with the square of the distance.
struct RenderLamp {
  glm::vec3 position{0};  ///< metres from the scene's origin
  glm::vec3 colour{1, 0.9f, 0.75f};
  float reach = 10;  ///< distance in metres at which the lamp lights a facing wall well; above 0
};

/// A camera at `position` that looks at `target`, with y up. Both are in metres from the scene's origin.
struct RenderCamera {
  glm::vec3 position{0};
  glm::vec3 target{0, 0, -1};
  float fov_degrees = 68;  ///< vertical field of view, 1..150
  int width = 1280;        ///< pixels, 1..kMaxPicture
  int height = 720;
};

enum class Background : uint32_t { cave, sky };

inline constexpr size_t kMaxLamps = 7;

struct RenderScene {
  std::span<const RenderVertex> vertices;
  std::span<const uint32_t> indices;  ///< three for each triangle, counter-clockwise seen from outside the solid
  std::span<const RenderMaterial> materials;  ///< at least one material
  /// World position of the scene's origin, in units. Surface patterns are fixed to the world, so that they do not
  /// depend on the choice of this origin.
  Int3 origin;
  RenderCamera camera;
  /// The lamp on the explorer's helmet, a little above and beside the camera, which shines in the camera's direction.
  /// RenderLamp::position is ignored.
  RenderLamp headlamp;
  std::vector<RenderLamp> lamps;  ///< fixed lamps in addition to the headlamp, at most kMaxLamps
  float ambient = 0.012f;         ///< strength of the ambient light, 0..1
  Background background = Background::cave;
  glm::vec3 sun_direction{-0.62f, 0.62f, 0.48f};  ///< direction to the sun; used only with Background::sky
  float fog_distance = 60;  ///< distance in metres over which haze extinguishes about two thirds of the light
  float exposure = 0.85f;
  int supersample = 2;  ///< samples along each side of a pixel, 1..3
  /// Polled on any thread while rays are traced; if it returns false, the picture is cancelled with Code::cancelled.
  /// May be empty.
  std::function<bool()> go_on;
};

}  // namespace sgm
