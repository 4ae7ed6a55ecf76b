#pragma once
// A Vulkan instance and device of our own, which runs one batch of commands at a time.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "backend/vulkan/devices.h"
#include "base/result.h"
#include "tools/render/drawing_table.h"

namespace sgm {

struct GpuOptions {
  int index = -1;           ///< index into listGpus(); -1: the device of the fastest kind available
  bool validation = false;  ///< loads VK_LAYER_KHRONOS_validation; its absence is an error
};

/// All devices of this machine with Vulkan 1.2, including those that cannot mesh. Error: unsupported if there is no
/// device, loader or driver.
Result<std::vector<vulkan::DeviceInfo>> listGpus();

/// Owns the instance, the device and one queue that draws and computes. Not thread-safe, except messages().
class VulkanDevice {
 public:
  /// Error: unsupported (no loader, no driver, no device with that index, no validation layer); the message names the
  /// package to install.
  static Result<std::unique_ptr<VulkanDevice>> create(const GpuOptions& options);
  ~VulkanDevice();
  VulkanDevice(const VulkanDevice&) = delete;
  VulkanDevice& operator=(const VulkanDevice&) = delete;

  /// Calls `record` to record commands, submits them and waits until they are done.
  Result<void> run(const std::function<void(VkCommandBuffer)>& record) const;

  /// Warnings and errors of the validation layer so far; empty if the layer is not loaded. Thread-safe.
  std::vector<std::string> messages() const { return instance_->messages(); }

  const vulkan::DeviceInfo& info() const { return info_; }
  const vulkan::InstanceTable& instanceCalls() const { return instance_->calls(); }
  const DrawingTable& calls() const { return calls_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return device_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }

 private:
  VulkanDevice() = default;
  Result<void> choose(int index);
  Result<void> open();

  std::unique_ptr<vulkan::Instance> instance_;
  DrawingTable calls_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  vulkan::DeviceInfo info_;
  VkPhysicalDeviceLimits limits_{};
};

}  // namespace sgm
