#pragma once
// The two passes that draw a picture: rasterizing the mesh into images of positions and normals, and shading.

#include <cstdint>
#include <span>

#include "tools/render/vulkan_scope.h"

namespace sgm {

/// First pass: rasterizes the position and the normal of the visible surface at each sample.
struct SurfacePass {
  VkExtent2D extent{};
  /// RGBA32F; rgb: position in metres from the scene's origin; alpha: material index + 1, or 0 for the background
  VulkanImage positions;
  VulkanImage normals;  ///< RGBA16F
  VkRenderPass render_pass = VK_NULL_HANDLE;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;  ///< layout of the push constants: FoliageConstants; `draw` uses only the
                                             ///< matrix
  VkPipeline draw = VK_NULL_HANDLE;
  VkPipeline foliage = VK_NULL_HANDLE;  ///< draws the ground under grass
  VkPipeline sprouts = VK_NULL_HANDLE;  ///< draws one blade or leaf for each instance
};

/// The shader stages that read SurfacePass's push constants.
inline constexpr VkShaderStageFlags kSurfaceStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// The second pass, which shades the samples. Its compiled shader contains only the patterns whose bits are set in
/// `patterns`, and the sky if the highest bit is set: compiling all patterns takes a driver seconds, compiling the
/// patterns of one scene far less.
struct ShadePipeline {
  uint32_t patterns = 0;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

/// Describes an attachment that is cleared at the beginning of its render pass.
VkAttachmentDescription clearedAttachment(VkFormat format, VkAttachmentStoreOp store, VkImageLayout final_layout);
Result<VkFramebuffer> makeFramebuffer(VulkanScope& scope, VkRenderPass render_pass, std::span<const VkImageView> views,
                                      VkExtent2D extent);

Result<SurfacePass> makeSurfacePass(VulkanScope& scope, VkExtent2D extent);
Result<ShadePipeline> makeShadePipeline(VulkanScope& scope, uint32_t patterns);

/// The buffers that the shading pass binds in addition to the images of SurfacePass.
struct ShadeBuffers {
  VulkanBuffer direct, frame, materials, pixels, soft, vapour;
};
Result<VkDescriptorSet> makeShadeSet(VulkanScope& scope, const ShadePipeline& pipeline, const SurfacePass& surfaces,
                                     const ShadeBuffers& buffers);

}  // namespace sgm
