#pragma once
// Runs compute shaders over storage buffers and hands the bytes back: what conformance tests compare.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "tools/render/vulkan_device.h"
#include "tools/render/vulkan_scope.h"

namespace sgm {

/// One storage buffer, bound at its index in the list. `data` is uploaded before the shader runs and overwritten with
/// what the shader left; std430 layout is the caller's business. Not empty, a multiple of 4 bytes.
struct ComputeBuffer {
  std::span<std::byte> data;
};

template <class T>
ComputeBuffer computeBuffer(std::span<T> values) {
  return {std::as_writable_bytes(values)};
}

/// A shader made ready once, to run often: making a pipeline of a large shader takes seconds. Outlived by its device.
class ComputeShader {
 public:
  ComputeShader(ComputeShader&&) = default;

  /// Runs it over groups x * y * z workgroups and waits. As many buffers, and as many bytes of push constants, as it
  /// was made for. Errors: invalid_argument, out_of_memory, unsupported.
  Result<void> run(std::span<const ComputeBuffer> buffers, std::span<const std::byte> push, uint32_t groups_x,
                   uint32_t groups_y = 1, uint32_t groups_z = 1) const;

 private:
  friend class VulkanCompute;
  explicit ComputeShader(const VulkanDevice& device)
      : scope_(std::make_unique<VulkanScope>(device)), device_(&device) {}

  std::unique_ptr<VulkanScope> scope_;  // owns what follows
  const VulkanDevice* device_;
  std::vector<VkDescriptorType> bindings_;
  size_t push_bytes_ = 0;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

class VulkanCompute {
 public:
  /// Opens the fastest device there is; lavapipe is enough. With validation the validation layer watches every call.
  /// Where this machine has no device: an empty value after a line on stderr that says why the test is skipped, or,
  /// with `require`, an Error. A missing validation layer is always an Error.
  static Result<std::optional<VulkanCompute>> create(bool require, bool validation);

  const vulkan::DeviceInfo& info() const { return device_->info(); }

  /// Makes `spirv` ready (entry "main", descriptor set 0, one storage buffer a binding from 0). push_bytes: at most
  /// 128, a multiple of 4. Errors: as run().
  Result<ComputeShader> shader(std::span<const uint32_t> spirv, size_t buffers, size_t push_bytes) const;

  /// Every warning and error of the validation layer so far. A test requires this to be empty.
  std::vector<std::string> messages() const { return device_->messages(); }

 private:
  explicit VulkanCompute(std::unique_ptr<VulkanDevice> device) : device_(std::move(device)) {}

  std::unique_ptr<VulkanDevice> device_;
};

}  // namespace sgm
