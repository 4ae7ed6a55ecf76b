#pragma once
// Owner of Vulkan objects that are destroyed together.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/render/vulkan_device.h"

namespace sgm {

/// A host-visible, coherent and permanently mapped buffer. The device reads each uploaded byte about once, so a copy to
/// device-local memory would take as long as reading the buffer in place.
struct VulkanBuffer {
  VkBuffer handle = VK_NULL_HANDLE;
  std::byte* data = nullptr;
  VkDeviceSize size = 0;
};

/// A device-local image with one mip level, and a view of the whole image.
struct VulkanImage {
  VkImage handle = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};

/// Creates Vulkan objects and owns them; its destructor destroys them in reverse order. Not thread-safe.
class VulkanScope {
 public:
  explicit VulkanScope(const VulkanDevice& device) : device_(device) {}
  ~VulkanScope();
  VulkanScope(const VulkanScope&) = delete;
  VulkanScope& operator=(const VulkanScope&) = delete;

  /// Precondition: bytes > 0.
  Result<VulkanBuffer> buffer(VkDeviceSize bytes, VkBufferUsageFlags usage);
  Result<VulkanImage> image(VkExtent2D extent, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect);
  /// A three-dimensional colour image.
  Result<VulkanImage> volume(VkExtent3D extent, VkFormat format, VkImageUsageFlags usage);
  /// A sampler with the given filter that clamps coordinates to the edge.
  Result<VkSampler> sampler(VkFilter filter = VK_FILTER_NEAREST);
  Result<VkShaderModule> shader(std::span<const uint32_t> spirv);
  /// Layout of a descriptor set: binding i has one descriptor of type types[i], visible to `stages`.
  Result<VkDescriptorSetLayout> setLayout(std::span<const VkDescriptorType> types, VkShaderStageFlags stages);
  Result<VkDescriptorSet> descriptorSet(VkDescriptorSetLayout layout, std::span<const VkDescriptorType> types);
  /// set: null if the layout has no descriptors. push_bytes: size of the push constants, or 0 for none.
  Result<VkPipelineLayout> pipelineLayout(VkDescriptorSetLayout set, VkShaderStageFlags stages, uint32_t push_bytes);
  Result<VkPipeline> computePipeline(VkShaderModule shader, VkPipelineLayout layout);
  Result<VkRenderPass> renderPass(const VkRenderPassCreateInfo& info);
  Result<VkFramebuffer> framebuffer(const VkFramebufferCreateInfo& info);
  Result<VkPipeline> graphicsPipeline(const VkGraphicsPipelineCreateInfo& info);

  const VulkanDevice& device() const { return device_; }

 private:
  template <class Info, class Handle>
  Result<Handle> make(VkResult (*create)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*),
                      void (*destroy)(VkDevice, Handle, const VkAllocationCallbacks*), const Info& info,
                      const std::string& what);
  Result<VulkanImage> image(VkImageCreateInfo info, VkImageViewType view_type, VkImageAspectFlags aspect,
                            const std::string& what);
  Result<VkDeviceMemory> memory(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted,
                                const std::string& what);

  const VulkanDevice& device_;
  std::vector<std::function<void()>> cleanups_;
};

}  // namespace sgm
