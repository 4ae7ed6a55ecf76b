#pragma once
// Chooses a camera that shows one of several targets from its most visible side.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "tools/render/scene.h"

namespace sgm::cli {

/// A part of the scene's mesh.
struct FrameTarget {
  glm::vec3 lo{0}, hi{0};           ///< its box, metres from the scene's origin
  std::vector<uint32_t> triangles;  ///< its triangles; at least one
};

struct FramedView {
  RenderCamera camera;
  size_t target = 0;  ///< index of the shown target
  float seen = 0;     ///< unoccluded share of its surfaces that face the camera
  float fill = 0;     ///< share of the picture's height or width that the target's box fills
};

inline constexpr float kFrameFill = 0.67f;

/// wish: size and angle; its places are ignored. isOpen: whether a place is outside all solids, called for few places.
/// The same answers give the same view. nullopt if no target is visible from anywhere. Error: out_of_memory.
Result<std::optional<FramedView>> frameTargets(std::span<const RenderVertex> vertices,
                                               std::span<const uint32_t> indices, std::span<const FrameTarget> targets,
                                               const RenderCamera& wish, const std::function<bool(glm::vec3)>& isOpen);

}  // namespace sgm::cli
