#pragma once
// Which places each light reaches: depth as seen from the lights, in one image of tiles.

#include <memory_resource>
#include <vector>

#include "render/frame.h"
#include "render/vulkan_scope.h"

namespace sgm {

/// A lamp's six tiles (+x -x +y -y +z -z) make one row; under a sky there is a single tile, the sun's.
/// shaders/render/shadow.glsl reads them.
inline constexpr uint32_t kLampTile = 512;
inline constexpr uint32_t kSunTile = 2048;
inline constexpr float kLampNear = 0.02f;  ///< metres from a lamp within which nothing casts a shadow
inline constexpr float kLampRange = 4.5f;  ///< a lamp's light ends at this many times its reach

struct ShadowTile {
  VkRect2D area{};
  glm::mat4 view_projection{1};
  uint32_t first_index = 0, index_count = 0;  ///< of ShadowPlan::indices
};

struct ShadowPlan {
  VkExtent2D extent{};
  std::vector<ShadowTile> tiles;
  /// Triangles that can stand in each light's way; the lights' lists one after the other.
  std::pmr::vector<uint32_t> indices;
};

/// frame must be the scene's.
ShadowPlan planShadows(const RenderScene& scene, const Frame& frame,
                       std::pmr::memory_resource* memory = std::pmr::get_default_resource());

struct ShadowPass {
  VulkanImage depth;
  VkRenderPass render_pass = VK_NULL_HANDLE;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;  ///< push constant: a tile's view-projection matrix
  VkPipeline draw = VK_NULL_HANDLE;
};

Result<ShadowPass> makeShadowPass(VulkanScope& scope, VkExtent2D extent);

/// Draws all tiles. `indices` holds the plan's, `vertices` the scene's.
void recordShadows(const DrawingTable& calls, VkCommandBuffer commands, const ShadowPlan& plan, const ShadowPass& pass,
                   const VulkanBuffer& vertices, const VulkanBuffer& indices);

}  // namespace sgm
