#pragma once
// The passes of a picture of fog: light through the volume, rays from the eye, and conversion to pixels.

#include "tools/render/volume.h"
#include "tools/render/vulkan_scope.h"

namespace sgm {

/// The resources of the passes.
struct VolumePass {
  VkExtent3D extent{}, lit_extent{};
  VkExtent2D picture{};
  VulkanBuffer upload, light, pixels;
  VulkanImage density, lit;
  VkDescriptorSet set = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline light_pipeline = VK_NULL_HANDLE, march = VK_NULL_HANDLE, compose = VK_NULL_HANDLE;
};

/// Contract: the scene is checked.
Result<VolumePass> makeVolumePass(VulkanScope& scope, const VolumeScene& scene);

/// Records the passes. When they have run, `light` and `pixels` may be read.
void recordVolume(const DrawingTable& calls, VkCommandBuffer commands, const VolumePass& pass);

}  // namespace sgm
