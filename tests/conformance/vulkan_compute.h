#pragma once
// Runs compute shaders on storage buffers, and returns the buffers' contents for comparison.

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

/// A storage buffer; its binding is its index in the list. `data` is uploaded before the shader runs, and afterwards
/// overwritten with the buffer's contents. It must have the std430 layout, must not be empty, and its size must be a
/// multiple of 4 bytes.
struct ComputeBuffer {
  std::span<std::byte> data;
};

template <class T>
ComputeBuffer computeBuffer(std::span<T> values) {
  return {std::as_writable_bytes(values)};
}

/// A compute shader with its pipeline. It is made once and run often, because making a large shader's pipeline takes
/// seconds. The device must outlive it.
class ComputeShader {
 public:
  ComputeShader(ComputeShader&&) = default;

  /// Runs the shader with groups_x * groups_y * groups_z workgroups, and waits for its end. The numbers of buffers and
  /// of push constant bytes must be those with which the shader was made. Errors: invalid_argument, out_of_memory,
  /// unsupported.
  Result<void> run(std::span<const ComputeBuffer> buffers, std::span<const std::byte> push, uint32_t groups_x,
                   uint32_t groups_y = 1, uint32_t groups_z = 1) const;

 private:
  friend class VulkanCompute;
  explicit ComputeShader(const VulkanDevice& device)
      : scope_(std::make_unique<VulkanScope>(device)), device_(&device) {}

  std::unique_ptr<VulkanScope> scope_;  // owns the Vulkan objects below
  const VulkanDevice* device_;
  std::vector<VkDescriptorType> bindings_;
  size_t push_bytes_ = 0;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

class VulkanCompute {
 public:
  /// Opens the fastest device, which may be lavapipe. validation: the validation layer checks every call. If this
  /// machine has no device, returns an Error if `require`; otherwise prints the reason to stderr and returns nullopt. A
  /// missing validation layer is always an Error.
  static Result<std::optional<VulkanCompute>> create(bool require, bool validation);

  const vulkan::DeviceInfo& info() const { return device_->info(); }

  /// Makes a pipeline from `spirv`, which must have the entry point "main" and one storage buffer for each binding from
  /// 0 of descriptor set 0. push_bytes: at most 128, a multiple of 4. Errors: those of run().
  Result<ComputeShader> shader(std::span<const uint32_t> spirv, size_t buffers, size_t push_bytes) const;

  /// Returns all warnings and errors of the validation layer so far. Tests require that there are none.
  std::vector<std::string> messages() const { return device_->messages(); }

 private:
  explicit VulkanCompute(std::unique_ptr<VulkanDevice> device) : device_(std::move(device)) {}

  std::unique_ptr<VulkanDevice> device_;
};

}  // namespace sgm
