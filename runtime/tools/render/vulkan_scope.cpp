#include "tools/render/vulkan_scope.h"

namespace sgm {

VulkanScope::~VulkanScope() {
  for (size_t i = cleanups_.size(); i-- > 0;) cleanups_[i]();
}

template <class Info, class Handle>
Result<Handle> VulkanScope::make(VkResult (*create)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*),
                                 void (*destroy)(VkDevice, Handle, const VkAllocationCallbacks*), const Info& info,
                                 const std::string& what) {
  Handle handle = VK_NULL_HANDLE;
  const VkResult result = create(device_.handle(), &info, nullptr, &handle);
  if (result != VK_SUCCESS) return vulkan::errorOf(result, what);
  cleanups_.push_back([device = device_.handle(), destroy, handle] { destroy(device, handle, nullptr); });
  return handle;
}

Result<VkDeviceMemory> VulkanScope::memory(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted,
                                           const std::string& what) {
  VkPhysicalDeviceMemoryProperties properties;
  device_.instanceCalls().vkGetPhysicalDeviceMemoryProperties(device_.physical(), &properties);
  uint32_t type = 0;
  while (type < properties.memoryTypeCount &&
         !((needs.memoryTypeBits >> type & 1) && (properties.memoryTypes[type].propertyFlags & wanted) == wanted)) {
    ++type;
  }
  if (type == properties.memoryTypeCount) return vulkan::errorOf(VK_ERROR_OUT_OF_DEVICE_MEMORY, what);
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = type;
  return make(device_.calls().vkAllocateMemory, device_.calls().vkFreeMemory, info, what);
}

Result<VulkanBuffer> VulkanScope::buffer(VkDeviceSize bytes, VkBufferUsageFlags usage) {
  const std::string what = "a GPU buffer of " + std::to_string(bytes) + " bytes";
  const DrawingTable& calls = device_.calls();
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = usage;
  // Clean-ups run in reverse order. The memory is registered first, so that it is freed after the buffer is destroyed.
  VkBuffer handle = VK_NULL_HANDLE;
  VkResult result = calls.vkCreateBuffer(device_.handle(), &info, nullptr, &handle);
  if (result != VK_SUCCESS) return vulkan::errorOf(result, what);
  VkMemoryRequirements needs;
  calls.vkGetBufferMemoryRequirements(device_.handle(), handle, &needs);
  auto allocated = memory(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, what);
  cleanups_.push_back([device = device_.handle(), &calls, handle] { calls.vkDestroyBuffer(device, handle, nullptr); });
  if (!allocated) return allocated.error();
  void* data = nullptr;
  result = calls.vkBindBufferMemory(device_.handle(), handle, *allocated, 0);
  if (result == VK_SUCCESS) result = calls.vkMapMemory(device_.handle(), *allocated, 0, VK_WHOLE_SIZE, 0, &data);
  if (result != VK_SUCCESS) return vulkan::errorOf(result, what);
  return VulkanBuffer{handle, static_cast<std::byte*>(data), bytes};
}

Result<VulkanImage> VulkanScope::image(VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
                                       VkImageAspectFlags aspect) {
  VkImageCreateInfo info{};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {extent.width, extent.height, 1};
  info.usage = usage;
  return image(info, VK_IMAGE_VIEW_TYPE_2D, aspect,
               "a GPU image of " + std::to_string(extent.width) + " x " + std::to_string(extent.height) + " pixels");
}

Result<VulkanImage> VulkanScope::volume(VkExtent3D extent, VkFormat format, VkImageUsageFlags usage) {
  VkImageCreateInfo info{};
  info.imageType = VK_IMAGE_TYPE_3D;
  info.format = format;
  info.extent = extent;
  info.usage = usage;
  return image(info, VK_IMAGE_VIEW_TYPE_3D, VK_IMAGE_ASPECT_COLOR_BIT,
               "a GPU volume of " + std::to_string(extent.width) + " x " + std::to_string(extent.height) + " x " +
                   std::to_string(extent.depth) + " points");
}

Result<VulkanImage> VulkanScope::image(VkImageCreateInfo info, VkImageViewType view_type, VkImageAspectFlags aspect,
                                       const std::string& what) {
  const DrawingTable& calls = device_.calls();
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  VkImage handle = VK_NULL_HANDLE;
  const VkResult result = calls.vkCreateImage(device_.handle(), &info, nullptr, &handle);
  if (result != VK_SUCCESS) return vulkan::errorOf(result, what);
  VkMemoryRequirements needs;
  calls.vkGetImageMemoryRequirements(device_.handle(), handle, &needs);
  auto allocated = memory(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, what);
  cleanups_.push_back([device = device_.handle(), &calls, handle] { calls.vkDestroyImage(device, handle, nullptr); });
  if (!allocated) return allocated.error();
  const VkResult bound = calls.vkBindImageMemory(device_.handle(), handle, *allocated, 0);
  if (bound != VK_SUCCESS) return vulkan::errorOf(bound, what);
  VkImageViewCreateInfo view{};
  view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view.image = handle;
  view.viewType = view_type;
  view.format = info.format;
  view.subresourceRange = {aspect, 0, 1, 0, 1};
  auto made = make(calls.vkCreateImageView, calls.vkDestroyImageView, view, what);
  if (!made) return made.error();
  return VulkanImage{handle, *made};
}

Result<VkSampler> VulkanScope::sampler(VkFilter filter) {
  VkSamplerCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = info.minFilter = filter;
  info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  return make(device_.calls().vkCreateSampler, device_.calls().vkDestroySampler, info, "a sampler");
}

Result<VkShaderModule> VulkanScope::shader(std::span<const uint32_t> spirv) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = spirv.size_bytes();
  info.pCode = spirv.data();
  return make(device_.calls().vkCreateShaderModule, device_.calls().vkDestroyShaderModule, info, "a shader");
}

Result<VkDescriptorSetLayout> VulkanScope::setLayout(std::span<const VkDescriptorType> types,
                                                     VkShaderStageFlags stages) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (VkDescriptorType type : types) {
    bindings.push_back({static_cast<uint32_t>(bindings.size()), type, 1, stages, nullptr});
  }
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = static_cast<uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  return make(device_.calls().vkCreateDescriptorSetLayout, device_.calls().vkDestroyDescriptorSetLayout, info,
              "a descriptor layout");
}

Result<VkDescriptorSet> VulkanScope::descriptorSet(VkDescriptorSetLayout layout,
                                                   std::span<const VkDescriptorType> types) {
  std::vector<VkDescriptorPoolSize> sizes;
  for (VkDescriptorType type : types) sizes.push_back({type, 1});
  VkDescriptorPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = static_cast<uint32_t>(sizes.size());
  pool_info.pPoolSizes = sizes.data();
  const DrawingTable& calls = device_.calls();
  auto pool = make(calls.vkCreateDescriptorPool, calls.vkDestroyDescriptorPool, pool_info, "a descriptor pool");
  if (!pool) return pool.error();
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = *pool;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  const VkResult result = calls.vkAllocateDescriptorSets(device_.handle(), &info, &set);
  if (result != VK_SUCCESS) return vulkan::errorOf(result, "a descriptor set");
  return set;
}

Result<VkPipelineLayout> VulkanScope::pipelineLayout(VkDescriptorSetLayout set, VkShaderStageFlags stages,
                                                     uint32_t push_bytes) {
  const VkPushConstantRange range{stages, 0, push_bytes};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = set ? 1 : 0;
  info.pSetLayouts = &set;
  info.pushConstantRangeCount = push_bytes ? 1 : 0;
  info.pPushConstantRanges = &range;
  return make(device_.calls().vkCreatePipelineLayout, device_.calls().vkDestroyPipelineLayout, info,
              "a pipeline layout");
}

Result<VkPipeline> VulkanScope::computePipeline(VkShaderModule shader, VkPipelineLayout layout) {
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = shader;
  info.stage.pName = "main";
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const DrawingTable& calls = device_.calls();
  const VkResult result =
      calls.vkCreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
  if (result != VK_SUCCESS) return vulkan::errorOf(result, "a compute pipeline");
  cleanups_.push_back(
      [device = device_.handle(), &calls, pipeline] { calls.vkDestroyPipeline(device, pipeline, nullptr); });
  return pipeline;
}

Result<VkRenderPass> VulkanScope::renderPass(const VkRenderPassCreateInfo& info) {
  return make(device_.calls().vkCreateRenderPass, device_.calls().vkDestroyRenderPass, info, "a render pass");
}

Result<VkFramebuffer> VulkanScope::framebuffer(const VkFramebufferCreateInfo& info) {
  return make(device_.calls().vkCreateFramebuffer, device_.calls().vkDestroyFramebuffer, info, "a framebuffer");
}

Result<VkPipeline> VulkanScope::graphicsPipeline(const VkGraphicsPipelineCreateInfo& info) {
  VkPipeline pipeline = VK_NULL_HANDLE;
  const DrawingTable& calls = device_.calls();
  const VkResult result =
      calls.vkCreateGraphicsPipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
  if (result != VK_SUCCESS) return vulkan::errorOf(result, "a graphics pipeline");
  cleanups_.push_back(
      [device = device_.handle(), &calls, pipeline] { calls.vkDestroyPipeline(device, pipeline, nullptr); });
  return pipeline;
}

}  // namespace sgm
