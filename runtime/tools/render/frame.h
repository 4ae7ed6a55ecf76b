#pragma once
// Uniform data of the shading pass, in the std140 and std430 layouts of shaders/render/frame.glsl.

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "base/result.h"
#include "tools/render/scene.h"

namespace sgm {

struct RenderFrame {
  glm::mat4 view_projection;
  glm::vec4 eye;
  glm::vec4 pattern_offset;
  glm::vec4 forward;
  glm::vec4 right;
  glm::vec4 up;
  glm::vec4 sun;
  glm::vec4 lamp_position[kMaxLamps + 1];
  glm::vec4 lamp_colour[kMaxLamps + 1];
  glm::uvec4 size;
  glm::uvec4 counts;
  glm::vec4 land;
};
static_assert(sizeof(RenderFrame) == 64 + 6 * 16 + 2 * 16 * (kMaxLamps + 1) + 48);

struct FrameMaterial {
  glm::vec4 colour_roughness;
  glm::uvec4 pattern;
};
static_assert(sizeof(FrameMaterial) == 32);

bool isFinite(const glm::vec3& v);

/// Error: invalid_argument if a camera value is out of range, or if position and target are equal.
Result<void> checkCamera(const RenderCamera& camera);

/// A camera's unit axes, and half of the width and height of its image plane at distance 1.
struct CameraAxes {
  glm::vec3 forward, right, up;
  float half_width, half_height;
};
/// Axes of a camera that checkCamera() accepts.
CameraAxes axesOf(const RenderCamera& camera);

/// Returns the frame of a scene that has been checked. RenderFrame::land stays empty until findLand() sets it.
RenderFrame frameOf(const RenderScene& scene);
/// Sets RenderFrame::land: the land that is drawn around the world, derived from the whole mesh. May throw
/// std::bad_alloc.
void findLand(const RenderScene& scene, RenderFrame& frame);
std::vector<FrameMaterial> frameMaterials(const RenderScene& scene);

}  // namespace sgm
