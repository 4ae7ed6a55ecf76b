#pragma once
// The two passes of a picture: the planes that the mesh is drawn into, and the pipelines of both.

#include <cstdint>
#include <span>

#include "render/vulkan_scope.h"

namespace sgm {

/// Position and normal of what each sample sees, drawn by `draw`.
struct SurfacePass {
  VkExtent2D extent{};
  VulkanImage positions;  ///< RGBA32F: metres; alpha: material + 1, 0 where nothing is seen
  VulkanImage normals;    ///< RGBA16F
  VkRenderPass render_pass = VK_NULL_HANDLE;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;  ///< push constant: the view-projection matrix
  VkPipeline draw = VK_NULL_HANDLE;
};

/// Reads the planes and writes pixels.
struct ShadePass {
  VkDescriptorSet set = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

/// An attachment that starts cleared.
VkAttachmentDescription clearedAttachment(VkFormat format, VkAttachmentStoreOp store, VkImageLayout final_layout);
Result<VkFramebuffer> makeFramebuffer(VulkanScope& scope, VkRenderPass render_pass, std::span<const VkImageView> views,
                                      VkExtent2D extent);

/// Draws RenderVertex triangles' fronts into reversed depth. With an empty fragment shader only depth is drawn and only
/// the vertices' positions are read; else two colour attachments.
Result<VkPipeline> makeMeshPipeline(VulkanScope& scope, VkRenderPass render_pass, VkPipelineLayout layout,
                                    std::span<const uint32_t> vertex_spirv, std::span<const uint32_t> fragment_spirv);

Result<SurfacePass> makeSurfacePass(VulkanScope& scope, VkExtent2D extent);
Result<ShadePass> makeShadePass(VulkanScope& scope, const SurfacePass& surfaces, const VulkanImage& shadows,
                                const VulkanBuffer& frame, const VulkanBuffer& materials, const VulkanBuffer& pixels);

}  // namespace sgm
