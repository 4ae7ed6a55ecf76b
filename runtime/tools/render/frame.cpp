#include "tools/render/frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "tools/render/image.h"
#include "tools/render/land.h"

namespace sgm {
namespace {

constexpr float kNear = 0.05f;  // metres from the camera to the near clipping plane
// The surface patterns repeat after this distance, in units. This keeps their coordinates small enough for float32.
constexpr int32_t kPatternUnits = 1024 * kUnitsPerMetre;

float wrapped(int32_t units) {
  const int32_t rest = ((units % kPatternUnits) + kPatternUnits) % kPatternUnits;
  return static_cast<float>(rest) / static_cast<float>(kUnitsPerMetre);
}

// The infinite far plane is at depth 0 and the near plane at depth 1 (reversed depth). Floats are densest near 0, which
// keeps precision at far distances.
glm::mat4 viewProjection(const RenderCamera& camera, const CameraAxes& axes) {
  const auto row = [&](glm::vec3 axis, float scale) {
    return glm::vec4(axis * scale, -glm::dot(axis, camera.position) * scale);
  };
  const glm::vec4 x = row(axes.right, 1 / axes.half_width), y = row(axes.up, 1 / axes.half_height),
                  w = row(axes.forward, 1);
  glm::mat4 m;
  for (int column = 0; column < 4; ++column) {
    m[column] = glm::vec4(x[column], y[column], column == 3 ? kNear : 0.0f, w[column]);
  }
  return m;
}

constexpr float kMeadow = 1e6f;   // value of RenderFrame::land.y for a meadow, as in shaders/render/frame.glsl
constexpr float kBeyond = 0.85f;  // the clouds that the shader adds to the sky begin at this share of the distance to
                                  // the farthest cloud in the mesh

bool hasFairWeather(const RenderScene& scene) {
  const auto isCloud = [](const RenderMaterial& one) { return one.pattern == SurfacePattern::cloud; };
  return scene.background == Background::sky && std::ranges::none_of(scene.materials, isCloud);
}

}  // namespace

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Result<void> checkCamera(const RenderCamera& camera) {
  const auto invalid = [](const std::string& message) { return Error{Code::invalid_argument, message}; };
  if (camera.width < 1 || camera.height < 1 || camera.width > kMaxPicture || camera.height > kMaxPicture) {
    return invalid("a picture must be 1 to " + std::to_string(kMaxPicture) + " pixels wide and high, not " +
                   std::to_string(camera.width) + " x " + std::to_string(camera.height));
  }
  if (!(camera.fov_degrees >= 1 && camera.fov_degrees <= 150)) {
    return invalid("the camera's field of view must be 1 to 150 degrees");
  }
  const glm::vec3 view = camera.target - camera.position;
  if (!isFinite(camera.position) || !isFinite(view) || !(glm::dot(view, view) > 0)) {
    return invalid("the camera needs a finite position and a different target");
  }
  return {};
}

CameraAxes axesOf(const RenderCamera& camera) {
  CameraAxes axes{};
  axes.forward = glm::normalize(camera.target - camera.position);
  // If the camera looks straight up or down, the cross product is 0: use the world's x axis as the right axis.
  const glm::vec3 level = glm::cross(axes.forward, glm::vec3(0, 1, 0));
  axes.right = glm::dot(level, level) > 1e-8f ? glm::normalize(level) : glm::vec3(1, 0, 0);
  axes.up = glm::cross(axes.right, axes.forward);
  axes.half_height = std::tan(glm::radians(camera.fov_degrees) / 2);
  axes.half_width = axes.half_height * static_cast<float>(camera.width) / static_cast<float>(camera.height);
  return axes;
}

RenderFrame frameOf(const RenderScene& scene) {
  const RenderCamera& camera = scene.camera;
  const CameraAxes axes = axesOf(camera);
  const float samples = static_cast<float>(camera.height * scene.supersample);
  RenderFrame frame{};
  frame.view_projection = viewProjection(camera, axes);
  frame.eye = glm::vec4(camera.position, 2 * axes.half_height / samples);
  frame.pattern_offset =
      glm::vec4(wrapped(scene.origin.x), wrapped(scene.origin.y), wrapped(scene.origin.z), scene.exposure);
  frame.forward = glm::vec4(axes.forward, scene.fog_distance);
  frame.right = glm::vec4(axes.right * axes.half_width, 0);
  frame.up = glm::vec4(axes.up * axes.half_height, 0);
  frame.sun = glm::vec4(glm::normalize(scene.sun_direction), scene.ambient);
  // The headlamp is a little above and beside the eye: near enough to light the whole view, far enough for visible
  // shadows.
  const float off = 0.05f * std::max(scene.headlamp.reach, 1.0f);
  frame.lamp_position[0] = glm::vec4(camera.position + axes.up * off + axes.right * (0.8f * off), scene.headlamp.reach);
  frame.lamp_colour[0] = glm::vec4(scene.headlamp.colour, 0);
  for (size_t i = 0; i < scene.lamps.size(); ++i) {
    frame.lamp_position[i + 1] = glm::vec4(scene.lamps[i].position, scene.lamps[i].reach);
    frame.lamp_colour[i + 1] = glm::vec4(scene.lamps[i].colour, 0);
  }
  frame.size = glm::uvec4(static_cast<uint32_t>(camera.width), static_cast<uint32_t>(camera.height),
                          static_cast<uint32_t>(scene.supersample), static_cast<uint32_t>(scene.background));
  frame.counts =
      glm::uvec4(static_cast<uint32_t>(scene.lamps.size() + 1), static_cast<uint32_t>(scene.materials.size()), 0, 0);
  frame.land = {0, -1, 0, hasFairWeather(scene) ? 1.0f : 0.0f};
  return frame;
}

void findLand(const RenderScene& scene, RenderFrame& frame) {
  if (scene.background != Background::sky) return;
  std::optional<Land> land = landAround(scene);
  if (!land) land = landUnderClouds(scene);
  if (!land) return;
  const float material = land->material == Land::kMeadow ? kMeadow : static_cast<float>(land->material);
  const float clouds = hasFairWeather(scene) ? 1 : -std::max(2.0f, kBeyond * reachOfClouds(scene));
  frame.land = {land->height, material, land->bare ? 1.0f : 0.0f, clouds};
}

std::vector<FrameMaterial> frameMaterials(const RenderScene& scene) {
  std::vector<FrameMaterial> materials;
  for (const RenderMaterial& m : scene.materials) {
    materials.push_back({glm::vec4(m.colour, std::clamp(m.roughness, 0.05f, 1.0f)),
                         glm::uvec4(static_cast<uint32_t>(m.pattern), std::bit_cast<uint32_t>(m.relief), 0, 0)});
  }
  return materials;
}

}  // namespace sgm
