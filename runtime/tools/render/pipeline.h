#pragma once
// The two passes of a picture: the planes that the mesh is drawn into, and the pipelines of both.

#include <cstdint>
#include <span>

#include "tools/render/vulkan_scope.h"

namespace sgm {

/// Position and normal of what each sample sees, drawn by `draw`.
struct SurfacePass {
  VkExtent2D extent{};
  VulkanImage positions;  ///< RGBA32F: metres; alpha: material + 1, 0 where nothing is seen
  VulkanImage normals;    ///< RGBA16F
  VkRenderPass render_pass = VK_NULL_HANDLE;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;  ///< push constants: those of foliage.h; `draw` takes the matrix alone
  VkPipeline draw = VK_NULL_HANDLE;
  VkPipeline foliage = VK_NULL_HANDLE;  ///< draws the ground of lawns
  VkPipeline sprouts = VK_NULL_HANDLE;  ///< draws blades and leaves, one an instance
};

/// The stages that read SurfacePass's push constants.
inline constexpr VkShaderStageFlags kSurfaceStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// Lights what is seen, made of the patterns whose bits are set, and of the sky where the highest is: a device compiles
/// the whole of it in seconds, and what a scene needs in far less.
struct ShadePipeline {
  uint32_t patterns = 0;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

/// An attachment that starts cleared.
VkAttachmentDescription clearedAttachment(VkFormat format, VkAttachmentStoreOp store, VkImageLayout final_layout);
Result<VkFramebuffer> makeFramebuffer(VulkanScope& scope, VkRenderPass render_pass, std::span<const VkImageView> views,
                                      VkExtent2D extent);

Result<SurfacePass> makeSurfacePass(VulkanScope& scope, VkExtent2D extent);
Result<ShadePipeline> makeShadePipeline(VulkanScope& scope, uint32_t patterns);

/// What lighting reads and writes beside the planes.
struct ShadeBuffers {
  VulkanBuffer direct, frame, materials, pixels, soft, vapour;
};
Result<VkDescriptorSet> makeShadeSet(VulkanScope& scope, const ShadePipeline& pipeline, const SurfacePass& surfaces,
                                     const ShadeBuffers& buffers);

}  // namespace sgm
