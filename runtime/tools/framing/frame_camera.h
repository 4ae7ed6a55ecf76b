#pragma once
// Chooses a camera that shows one of several targets from the side that is most visible.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "tools/render/scene.h"

namespace sgm::cli {

/// One candidate to show: a part of the scene's mesh.
struct FrameTarget {
  glm::vec3 lo{0}, hi{0};           ///< bounding box of the triangles, metres from the scene's origin
  std::vector<uint32_t> triangles;  ///< indices of the part's triangles; at least one
};

struct FramedView {
  RenderCamera camera;
  size_t target = 0;  ///< index of the chosen target
  float seen = 0;     ///< share of the target's surfaces facing the camera that nothing hides
  float fill = 0;     ///< share of the picture's height or width that the target's bounding box fills
};

inline constexpr float kFrameFill = 0.67f;

/// Chooses the camera. wish: gives picture size and angle of view; its position and target are ignored. isOpen: returns
/// whether a place is outside all solids; called for few places. The result depends only on the arguments and on
/// isOpen's answers. Returns nullopt if no target is visible from anywhere. Error: out_of_memory.
Result<std::optional<FramedView>> frameTargets(std::span<const RenderVertex> vertices,
                                               std::span<const uint32_t> indices, std::span<const FrameTarget> targets,
                                               const RenderCamera& request,
                                               const std::function<bool(glm::vec3)>& isOpen);

}  // namespace sgm::cli
