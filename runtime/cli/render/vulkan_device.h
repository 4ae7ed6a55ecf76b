#pragma once
// A Vulkan instance and device of our own: chosen, opened, and able to run one batch of commands at a time.

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/result.h"
#include "render/vulkan_table.h"

namespace sgm {

/// What a Vulkan device says of itself.
struct GpuInfo {
  std::string name;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  uint32_t api_version = 0;
  bool software = false;  ///< runs on the CPU (lavapipe and its like)
  /// shaderRoundingModeRTEFloat32: shaders may demand round-to-nearest, so the arithmetic contract holds on it.
  bool rounds_to_nearest = false;
  bool preserves_denormals = false;  ///< shaderDenormPreserveFloat32
};

struct GpuOptions {
  int index = -1;           ///< in the order of listGpus(); -1 takes the fastest kind there is
  bool validation = false;  ///< load VK_LAYER_KHRONOS_validation; an error where it is not installed
};

/// The text and Code for a failed Vulkan call; `what` says what was being done.
Error vulkanError(VkResult result, const std::string& what);

/// Every Vulkan device of this machine that has Vulkan 1.2. Errors: unsupported, where there is no loader or driver.
Result<std::vector<GpuInfo>> listGpus();

/// Owns the instance, the device and one queue that draws and computes. One thread at a time may use it.
class VulkanDevice {
 public:
  /// Errors: unsupported (no loader, no driver, no such index, no validation layer), with what to install.
  static Result<std::unique_ptr<VulkanDevice>> create(const GpuOptions& options);
  ~VulkanDevice();
  VulkanDevice(const VulkanDevice&) = delete;
  VulkanDevice& operator=(const VulkanDevice&) = delete;

  /// Records commands through `record`, submits them and waits until they are done.
  Result<void> run(const std::function<void(VkCommandBuffer)>& record) const;

  /// Warnings and errors of the validation layer so far; empty when created without it. Any thread.
  std::vector<std::string> messages() const;

  const GpuInfo& info() const { return info_; }
  const VulkanInstanceTable& instanceCalls() const { return instance_calls_; }
  const VulkanDeviceTable& calls() const { return calls_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return device_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }

 private:
  struct Messages {
    std::mutex mutex;
    std::vector<std::string> texts;
  };
  friend struct VulkanDeviceBuilder;

  VulkanDevice() = default;

  VulkanGlobalTable global_calls_;
  VulkanInstanceTable instance_calls_;
  VulkanDeviceTable calls_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  GpuInfo info_;
  VkPhysicalDeviceLimits limits_{};
  std::unique_ptr<Messages> messages_ = std::make_unique<Messages>();
};

}  // namespace sgm
