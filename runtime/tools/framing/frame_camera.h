#pragma once
// A camera that shows one of several things from the side that it is seen best from.

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
  std::vector<uint32_t> triangles;  ///< that it consists of; at least one
};

struct FramedView {
  RenderCamera camera;
  size_t target = 0;  ///< which of them
  float seen = 0;     ///< share of what faces the camera there that nothing hides
  float fill = 0;     ///< share of the picture's height or width that the target's box takes
};

inline constexpr float kFrameFill = 0.67f;

/// wish: a size and an angle; its places are not used. isOpen: whether a place is outside of all that is solid, asked
/// for few places. The same answers give the same view. nullopt if no target is in sight from anywhere. Error:
/// out_of_memory.
Result<std::optional<FramedView>> frameTargets(std::span<const RenderVertex> vertices,
                                               std::span<const uint32_t> indices, std::span<const FrameTarget> targets,
                                               const RenderCamera& wish, const std::function<bool(glm::vec3)>& isOpen);

}  // namespace sgm::cli
