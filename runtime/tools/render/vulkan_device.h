#pragma once
// A Vulkan instance and device that the renderer owns. The device runs one batch of commands at a time.

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
  int index = -1;           ///< index into the result of listGpus(); -1: a device of the fastest kind
  bool validation = false;  ///< loads VK_LAYER_KHRONOS_validation; create() fails if it is not installed
};

/// All devices of this machine that support Vulkan 1.2, including those on which meshing is not supported. Error:
/// unsupported if there is no device, loader or driver.
Result<std::vector<vulkan::DeviceInfo>> listGpus();

/// Owns a Vulkan instance, a device, and a queue for graphics and compute. Not thread-safe, except messages().
class VulkanDevice {
 public:
  /// Error: unsupported if there is no loader, no driver, no device with that index or no validation layer; the message
  /// then names the package to install.
  static Result<std::unique_ptr<VulkanDevice>> create(const GpuOptions& options);
  ~VulkanDevice();
  VulkanDevice(const VulkanDevice&) = delete;
  VulkanDevice& operator=(const VulkanDevice&) = delete;

  /// Lets `record` record commands, submits them and waits until the device has run them.
  Result<void> run(const std::function<void(VkCommandBuffer)>& record) const;

  /// All warnings and errors of the validation layer so far; empty if the layer is not loaded. Thread-safe.
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
