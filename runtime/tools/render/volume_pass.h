#pragma once
// The compute passes that draw a picture of fog: light in the volume, ray marching from the eye, and conversion to
// pixels.

#include "tools/render/volume.h"
#include "tools/render/vulkan_scope.h"

namespace sgm {

/// The Vulkan resources of the fog passes.
struct VolumePass {
  VkExtent3D extent{}, lit_extent{};
  VkExtent2D picture{};
  VulkanBuffer upload, light, pixels;
  VulkanImage density, lit;
  VkDescriptorSet set = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline light_pipeline = VK_NULL_HANDLE, march = VK_NULL_HANDLE, compose = VK_NULL_HANDLE;
};

/// Makes the resources of the fog passes and uploads the scene. Contract: the scene has been checked.
Result<VolumePass> makeVolumePass(VulkanScope& scope, const VolumeScene& scene);

/// Records the fog passes. When the device has run them, the host may read `light` and `pixels`.
void recordVolume(const DrawingTable& calls, VkCommandBuffer commands, const VolumePass& pass);

}  // namespace sgm
