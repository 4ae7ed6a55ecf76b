#pragma once
// Vulkan objects whose lifetime is that of the scope that made them.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/render/vulkan_device.h"

namespace sgm {

/// Host-visible, coherent and permanently mapped. Each uploaded byte is read about once, so copying to device memory
/// would cost as much as reading it in place.
struct VulkanBuffer {
  VkBuffer handle = VK_NULL_HANDLE;
  std::byte* data = nullptr;
  VkDeviceSize size = 0;
};

/// Device-local, one mip level, with a view of the whole.
struct VulkanImage {
  VkImage handle = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};

/// Creates objects, and destroys them in reverse order in its destructor. Not thread-safe.
class VulkanScope {
 public:
  explicit VulkanScope(const VulkanDevice& device) : device_(device) {}
  ~VulkanScope();
  VulkanScope(const VulkanScope&) = delete;
  VulkanScope& operator=(const VulkanScope&) = delete;

  /// bytes > 0.
  Result<VulkanBuffer> buffer(VkDeviceSize bytes, VkBufferUsageFlags usage);
  Result<VulkanImage> image(VkExtent2D extent, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect);
  /// Of three dimensions, in colour.
  Result<VulkanImage> volume(VkExtent3D extent, VkFormat format, VkImageUsageFlags usage);
  /// Clamped to the edge.
  Result<VkSampler> sampler(VkFilter filter = VK_FILTER_NEAREST);
  Result<VkShaderModule> shader(std::span<const uint32_t> spirv);
  /// One set of one descriptor a binding, numbered from 0, all visible to `stages`.
  Result<VkDescriptorSetLayout> setLayout(std::span<const VkDescriptorType> types, VkShaderStageFlags stages);
  Result<VkDescriptorSet> descriptorSet(VkDescriptorSetLayout layout, std::span<const VkDescriptorType> types);
  /// set may be null: no descriptors; push_bytes 0: no push constants.
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
