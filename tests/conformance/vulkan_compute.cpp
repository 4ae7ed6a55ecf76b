#include "conformance/vulkan_compute.h"

#include <cstdio>
#include <cstring>
#include <utility>

namespace sgm {
namespace {

constexpr size_t kMaxPushBytes = 128;  // maximum size of push constants in bytes that every Vulkan device supports

Result<void> checkBuffers(const VulkanDevice& device, std::span<const ComputeBuffer> buffers) {
  for (const ComputeBuffer& buffer : buffers) {
    if (buffer.data.empty() || buffer.data.size() % 4 || buffer.data.size() > device.limits().maxStorageBufferRange) {
      return Error{Code::invalid_argument, "a storage buffer has 4 to " +
                                               std::to_string(device.limits().maxStorageBufferRange) +
                                               " bytes here, in fours, not " + std::to_string(buffer.data.size())};
    }
  }
  return {};
}

Result<void> checkGroups(const VulkanDevice& device, const uint32_t (&groups)[3]) {
  for (size_t i = 0; i < 3; ++i) {
    if (groups[i] == 0 || groups[i] > device.limits().maxComputeWorkGroupCount[i]) {
      return Error{Code::invalid_argument, "too many or no workgroups on an axis: " + std::to_string(groups[i])};
    }
  }
  return {};
}

}  // namespace

Result<std::optional<VulkanCompute>> VulkanCompute::create(bool require, bool validation) {
  auto gpus = listGpus();
  if (!gpus) {
    if (require) return gpus.error();
    std::fprintf(stderr, "SKIPPED: %s\n", gpus.error().message.c_str());
    return std::optional<VulkanCompute>();
  }
  GpuOptions options;
  options.validation = validation;
  auto device = VulkanDevice::create(options);
  if (!device) return device.error();
  return std::optional<VulkanCompute>(VulkanCompute(std::move(*device)));
}

Result<ComputeShader> VulkanCompute::shader(std::span<const uint32_t> spirv, size_t buffers, size_t push_bytes) const {
  const uint32_t max_buffers = device_->limits().maxPerStageDescriptorStorageBuffers;
  if (spirv.empty()) return Error{Code::invalid_argument, "no shader given"};
  if (buffers == 0 || buffers > max_buffers) {
    return Error{Code::invalid_argument, "a shader takes 1 to " + std::to_string(max_buffers) +
                                             " storage buffers here, not " + std::to_string(buffers)};
  }
  if (push_bytes > kMaxPushBytes || push_bytes % 4) {
    return Error{Code::invalid_argument, "push constants have at most 128 bytes, in fours"};
  }
  ComputeShader made(*device_);
  made.bindings_.assign(buffers, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  made.push_bytes_ = push_bytes;
  auto module = made.scope_->shader(spirv);
  if (!module) return module.error();
  auto set_layout = made.scope_->setLayout(made.bindings_, VK_SHADER_STAGE_COMPUTE_BIT);
  if (!set_layout) return set_layout.error();
  auto layout =
      made.scope_->pipelineLayout(*set_layout, VK_SHADER_STAGE_COMPUTE_BIT, static_cast<uint32_t>(push_bytes));
  if (!layout) return layout.error();
  auto pipeline = made.scope_->computePipeline(*module, *layout);
  if (!pipeline) return pipeline.error();
  made.set_layout_ = *set_layout;
  made.layout_ = *layout;
  made.pipeline_ = *pipeline;
  return made;
}

Result<void> ComputeShader::run(std::span<const ComputeBuffer> buffers, std::span<const std::byte> push,
                                uint32_t groups_x, uint32_t groups_y, uint32_t groups_z) const {
  if (buffers.size() != bindings_.size() || push.size() != push_bytes_) {
    return Error{Code::invalid_argument, "this shader was made for " + std::to_string(bindings_.size()) +
                                             " buffers and " + std::to_string(push_bytes_) +
                                             " bytes of push constants"};
  }
  if (auto checked = checkBuffers(*device_, buffers); !checked) return checked.error();
  if (auto checked = checkGroups(*device_, {groups_x, groups_y, groups_z}); !checked) return checked.error();
  VulkanScope scope(*device_);
  auto set = scope.descriptorSet(set_layout_, bindings_);
  if (!set) return set.error();

  const DrawingTable& calls = device_->calls();
  std::vector<VulkanBuffer> memory;
  for (const ComputeBuffer& buffer : buffers) {
    auto made = scope.buffer(buffer.data.size(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    if (!made) return made.error();
    std::memcpy(made->data, buffer.data.data(), buffer.data.size());
    const VkDescriptorBufferInfo range{made->handle, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = *set;
    write.dstBinding = static_cast<uint32_t>(memory.size());
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &range;
    calls.vkUpdateDescriptorSets(device_->handle(), 1, &write, 0, nullptr);
    memory.push_back(*made);
  }
  auto done = device_->run([&](VkCommandBuffer commands) {
    calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    calls.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &*set, 0, nullptr);
    if (!push.empty()) {
      calls.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<uint32_t>(push.size()),
                               push.data());
    }
    calls.vkCmdDispatch(commands, groups_x, groups_y, groups_z);
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    calls.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                               &barrier, 0, nullptr, 0, nullptr);
  });
  if (!done) return done.error();
  for (size_t i = 0; i < buffers.size(); ++i) {
    std::memcpy(buffers[i].data.data(), memory[i].data, buffers[i].data.size());
  }
  return {};
}

}  // namespace sgm
