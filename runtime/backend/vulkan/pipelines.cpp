#include "backend/vulkan/pipelines.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "backend/vulkan/pipeline_cache.h"

namespace sgm::vulkan {
namespace {

constexpr uint32_t kMaxPushBytes = 128;

Result<void> checkDesc(const Device& device, const PipelineDesc& desc) {
  const auto refused = [&](const std::string& why) {
    return Error{Code::invalid_argument, std::string("the shader ") + desc.name + " " + why};
  };
  const uint32_t most = std::min(kMaxBuffers, device.info().max_storage_buffers);
  if (desc.spirv.empty()) return refused("is empty");
  if (desc.buffers > most) {
    return refused("takes " + std::to_string(desc.buffers) + " buffers, but the limit is " + std::to_string(most));
  }
  if (desc.push_bytes > kMaxPushBytes || desc.push_bytes % 4) {
    return refused("has " + std::to_string(desc.push_bytes) +
                   " bytes of push constants: use a multiple of 4, at most 128");
  }
  return {};
}

}  // namespace

Result<Pipeline> Pipeline::create(Device& device, const PipelineDesc& desc, const PipelineCache* cache) {
  if (auto checked = checkDesc(device, desc); !checked) return checked.error();
  Pipeline pipeline(device);
  pipeline.buffers_ = desc.buffers;
  pipeline.push_bytes_ = desc.push_bytes;
  VkResult result = pipeline.makeLayouts();
  if (result == VK_SUCCESS) result = pipeline.makePipeline(desc, cache ? cache->handle() : VK_NULL_HANDLE);
  if (result != VK_SUCCESS)
    return errorOf(result, std::string("compiling the shader ") + desc.name + " for the device");
  return pipeline;
}

Pipeline::Pipeline(Pipeline&& other) noexcept
    : device_(other.device_),
      set_layout_(std::exchange(other.set_layout_, VK_NULL_HANDLE)),
      layout_(std::exchange(other.layout_, VK_NULL_HANDLE)),
      pipeline_(std::exchange(other.pipeline_, VK_NULL_HANDLE)),
      buffers_(other.buffers_),
      push_bytes_(other.push_bytes_) {}

Pipeline::~Pipeline() {
  const DeviceTable& calls = device_.calls();
  calls.vkDestroyPipeline(device_.handle(), pipeline_, nullptr);
  calls.vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
  calls.vkDestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
}

VkResult Pipeline::makeLayouts() {
  std::array<VkDescriptorSetLayoutBinding, kMaxBuffers> bindings{};
  for (uint32_t i = 0; i < buffers_; ++i) {
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  }
  VkDescriptorSetLayoutCreateInfo set{};
  set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  set.bindingCount = buffers_;
  set.pBindings = bindings.data();
  const DeviceTable& calls = device_.calls();
  const VkResult result = calls.vkCreateDescriptorSetLayout(device_.handle(), &set, nullptr, &set_layout_);
  if (result != VK_SUCCESS) return result;
  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes_};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout_;
  info.pushConstantRangeCount = push_bytes_ ? 1 : 0;
  info.pPushConstantRanges = &range;
  return calls.vkCreatePipelineLayout(device_.handle(), &info, nullptr, &layout_);
}

VkResult Pipeline::makePipeline(const PipelineDesc& desc, VkPipelineCache cache) {
  std::vector<VkSpecializationMapEntry> entries;
  for (uint32_t i = 0; i < desc.constants.size(); ++i) entries.push_back({i, 4 * i, sizeof(uint32_t)});
  const VkSpecializationInfo constants{static_cast<uint32_t>(entries.size()), entries.data(),
                                       desc.constants.size_bytes(), desc.constants.data()};
  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = desc.spirv.size_bytes();
  module_info.pCode = desc.spirv.data();
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &constants;
  info.layout = layout_;
  const DeviceTable& calls = device_.calls();
  VkResult result = calls.vkCreateShaderModule(device_.handle(), &module_info, nullptr, &info.stage.module);
  if (result != VK_SUCCESS) return result;
  result = calls.vkCreateComputePipelines(device_.handle(), cache, 1, &info, nullptr, &pipeline_);
  calls.vkDestroyShaderModule(device_.handle(), info.stage.module, nullptr);
  return result;
}

}  // namespace sgm::vulkan
