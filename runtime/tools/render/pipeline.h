#pragma once
// The two passes of a picture: rasterizing the mesh's surfaces into planes, and shading.

#include <cstdint>
#include <span>

#include "tools/render/vulkan_scope.h"

namespace sgm {

/// Position and normal of the surface at each sample, rasterized by `draw`.
struct SurfacePass {
  VkExtent2D extent{};
  /// RGBA32F; rgb: metres from the scene's origin; alpha: material index + 1, or 0 for the background
  VulkanImage positions;
  VulkanImage normals;  ///< RGBA16F
  VkRenderPass render_pass = VK_NULL_HANDLE;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;  ///< push constants are FoliageConstants; `draw` uses only the matrix
  VkPipeline draw = VK_NULL_HANDLE;
  VkPipeline foliage = VK_NULL_HANDLE;  ///< draws the ground of lawns
  VkPipeline sprouts = VK_NULL_HANDLE;  ///< draws blades and leaves, one for each instance
};

/// The shader stages that read SurfacePass's push constants.
inline constexpr VkShaderStageFlags kSurfaceStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// Shades the samples. The shader contains only the patterns whose bits are set in `patterns`, and the sky if the
/// highest bit is set: a driver needs seconds to compile all patterns, and far less for those of a single scene.
struct ShadePipeline {
  uint32_t patterns = 0;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

/// An attachment that is cleared at the beginning of its render pass.
VkAttachmentDescription clearedAttachment(VkFormat format, VkAttachmentStoreOp store, VkImageLayout final_layout);
Result<VkFramebuffer> makeFramebuffer(VulkanScope& scope, VkRenderPass render_pass, std::span<const VkImageView> views,
                                      VkExtent2D extent);

Result<SurfacePass> makeSurfacePass(VulkanScope& scope, VkExtent2D extent);
Result<ShadePipeline> makeShadePipeline(VulkanScope& scope, uint32_t patterns);

/// The buffers of the shading pass, in addition to the planes.
struct ShadeBuffers {
  VulkanBuffer direct, frame, materials, pixels, soft, vapour;
};
Result<VkDescriptorSet> makeShadeSet(VulkanScope& scope, const ShadePipeline& pipeline, const SurfacePass& surfaces,
                                     const ShadeBuffers& buffers);

}  // namespace sgm
