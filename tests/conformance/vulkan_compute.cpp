#include "conformance/vulkan_compute.h"

#include <cstdio>
#include <cstring>
#include <utility>

#include "render/vulkan_scope.h"

namespace sgm {
namespace {

constexpr size_t kMaxPushBytes = 128;  // what every Vulkan device has

Result<void> checkArguments(const VulkanDevice& device, std::span<const uint32_t> spirv,
                            std::span<const ComputeBuffer> buffers, std::span<const std::byte> push,
                            const uint32_t (&groups)[3]) {
  if (spirv.empty()) return Error{Code::invalid_argument, "no shader given"};
  if (buffers.empty() || buffers.size() > device.limits().maxPerStageDescriptorStorageBuffers) {
    return Error{Code::invalid_argument, "a shader takes 1 to " +
                                             std::to_string(device.limits().maxPerStageDescriptorStorageBuffers) +
                                             " storage buffers here, not " + std::to_string(buffers.size())};
  }
  for (const ComputeBuffer& buffer : buffers) {
    if (buffer.data.empty() || buffer.data.size() % 4 || buffer.data.size() > device.limits().maxStorageBufferRange) {
      return Error{Code::invalid_argument, "a storage buffer has 4 to " +
                                               std::to_string(device.limits().maxStorageBufferRange) +
                                               " bytes here, in fours, not " + std::to_string(buffer.data.size())};
    }
  }
  if (push.size() > kMaxPushBytes || push.size() % 4) {
    return Error{Code::invalid_argument, "push constants have at most 128 bytes, in fours"};
  }
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

Result<void> VulkanCompute::run(std::span<const uint32_t> spirv, std::span<const ComputeBuffer> buffers,
                                std::span<const std::byte> push, uint32_t groups_x, uint32_t groups_y,
                                uint32_t groups_z) const {
  const uint32_t groups[3] = {groups_x, groups_y, groups_z};
  if (auto checked = checkArguments(*device_, spirv, buffers, push, groups); !checked) return checked.error();
  VulkanScope scope(*device_);
  const std::vector<VkDescriptorType> types(buffers.size(), VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  auto shader = scope.shader(spirv);
  if (!shader) return shader.error();
  auto set_layout = scope.setLayout(types, VK_SHADER_STAGE_COMPUTE_BIT);
  if (!set_layout) return set_layout.error();
  auto layout = scope.pipelineLayout(*set_layout, VK_SHADER_STAGE_COMPUTE_BIT, static_cast<uint32_t>(push.size()));
  if (!layout) return layout.error();
  auto pipeline = scope.computePipeline(*shader, *layout);
  if (!pipeline) return pipeline.error();
  auto set = scope.descriptorSet(*set_layout, types);
  if (!set) return set.error();

  const VulkanDeviceTable& calls = device_->calls();
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
    calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, *pipeline);
    calls.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, *layout, 0, 1, &*set, 0, nullptr);
    if (!push.empty()) {
      calls.vkCmdPushConstants(commands, *layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<uint32_t>(push.size()),
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
