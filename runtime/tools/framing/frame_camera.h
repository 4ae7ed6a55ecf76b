#pragma once
// Chooses a camera that shows one of several targets from the direction in which most of the target is visible.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "tools/render/scene.h"

namespace sgm::cli {

/// A target that the camera may show: a part of the scene's mesh.
struct FrameTarget {
  glm::vec3 lo{0}, hi{0};           ///< bounding box of the triangles, metres from the scene's origin
  std::vector<uint32_t> triangles;  ///< indices of the triangles of this part; at least one
};

struct FramedView {
  RenderCamera camera;
  size_t target = 0;  ///< index of the chosen target
  float seen = 0;     ///< visible share of the surfaces of the target that face the camera
  float fill = 0;     ///< share of the picture's height or width that the target's bounding box fills
};

inline constexpr float kFrameFill = 0.67f;

/// Chooses the camera and the target. request: gives picture size and field of view; its position and target are
/// ignored. isOpen: returns whether a place is outside all solids; called for few places. The result depends only on
/// the arguments and on the results of isOpen. Returns nullopt if no target is visible from anywhere. Error:
/// out_of_memory.
Result<std::optional<FramedView>> frameTargets(std::span<const RenderVertex> vertices,
                                               std::span<const uint32_t> indices, std::span<const FrameTarget> targets,
                                               const RenderCamera& request,
                                               const std::function<bool(glm::vec3)>& isOpen);

}  // namespace sgm::cli
