#pragma once
// Runs one compute shader over storage buffers and hands the bytes back: what conformance tests compare.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "render/vulkan_device.h"

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

class VulkanCompute {
 public:
  /// Opens the fastest device there is; lavapipe is enough. With validation the validation layer watches every call.
  /// Where this machine has no device: an empty value after a line on stderr that says why the test is skipped, or,
  /// with `require`, an Error. A missing validation layer is always an Error.
  static Result<std::optional<VulkanCompute>> create(bool require, bool validation);

  const GpuInfo& info() const { return device_->info(); }

  /// Runs `spirv` (entry "main", descriptor set 0, one storage buffer a binding from 0) over groups x * y * z
  /// workgroups and waits. push: at most 128 bytes, a multiple of 4. Errors: invalid_argument, out_of_memory,
  /// unsupported.
  Result<void> run(std::span<const uint32_t> spirv, std::span<const ComputeBuffer> buffers,
                   std::span<const std::byte> push, uint32_t groups_x, uint32_t groups_y = 1,
                   uint32_t groups_z = 1) const;

  /// Every warning and error of the validation layer so far. A test requires this to be empty.
  std::vector<std::string> messages() const { return device_->messages(); }

 private:
  explicit VulkanCompute(std::unique_ptr<VulkanDevice> device) : device_(std::move(device)) {}

  std::unique_ptr<VulkanDevice> device_;
};

}  // namespace sgm
