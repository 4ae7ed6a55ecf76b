#pragma once
// Runs compute shaders over storage buffers, and returns the buffers' bytes for comparison.

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

/// One storage buffer; its binding is its index in the list. `data` is uploaded before the shader runs, and overwritten
/// with the buffer's contents afterwards. The caller must use the std430 layout. Not empty, a multiple of 4 bytes.
struct ComputeBuffer {
  std::span<std::byte> data;
};

template <class T>
ComputeBuffer computeBuffer(std::span<T> values) {
  return {std::as_writable_bytes(values)};
}

/// A shader with its pipeline, made once and run often, because making a large shader's pipeline takes seconds. The
/// device must outlive it.
class ComputeShader {
 public:
  ComputeShader(ComputeShader&&) = default;

  /// Runs the shader over groups x * y * z workgroups, and waits for the end. The numbers of buffers and of push
  /// constant bytes must be those with which the shader was made. Errors: invalid_argument, out_of_memory, unsupported.
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
  /// Opens the fastest device; lavapipe suffices. validation: the validation layer checks every call. If this machine
  /// has no device, prints the reason to stderr and returns an empty value, or, with `require`, an Error. A missing
  /// validation layer is always an Error.
  static Result<std::optional<VulkanCompute>> create(bool require, bool validation);

  const vulkan::DeviceInfo& info() const { return device_->info(); }

  /// Makes a pipeline for `spirv` (entry point "main", descriptor set 0, one storage buffer for each binding from 0).
  /// push_bytes: at most 128, a multiple of 4. Errors: as run().
  Result<ComputeShader> shader(std::span<const uint32_t> spirv, size_t buffers, size_t push_bytes) const;

  /// All warnings and errors of the validation layer so far. Tests require that there are none.
  std::vector<std::string> messages() const { return device_->messages(); }

 private:
  explicit VulkanCompute(std::unique_ptr<VulkanDevice> device) : device_(std::move(device)) {}

  std::unique_ptr<VulkanDevice> device_;
};

}  // namespace sgm
