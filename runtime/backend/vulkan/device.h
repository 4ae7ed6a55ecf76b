#pragma once
// The device that the Vulkan backend computes on: one of our own, or the engine's, borrowed.

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "backend/vulkan/devices.h"

namespace sgm::vulkan {

/// May replace entries of the device's table before any of them is called; for tests that make calls fail.
using ReplaceCalls = std::function<void(DeviceTable&)>;

struct OwnDevice {
  int index = -1;         ///< in the order of listDevices(); -1 takes the fastest kind that can be used
  bool software = false;  ///< index -1: take a software device where there is no hardware
  Validation validation = Validation::none;
  std::shared_ptr<MessageLog> log = nullptr;  ///< as InstanceOptions::log
  std::function<void(InstanceTable&)> replace_instance_calls = nullptr;
  ReplaceCalls replace_calls = nullptr;
};

/// An engine's device. All handles must outlive the Device that borrows them.
struct BorrowedDevice {
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t family = 0;            ///< the queue's
  std::vector<uint32_t> readers;  ///< families of other queues that use meshes
  /// Called around every use of the queue, on the thread that submits; both or neither. null: nobody but us uses it.
  void (*lock)(void* user) = nullptr;
  void (*unlock)(void* user) = nullptr;
  void* user = nullptr;
  // What the engine enabled, which Vulkan does not tell:
  uint32_t api_version = 0;            ///< VkApplicationInfo::apiVersion
  bool timeline_semaphores = false;    ///< the feature timelineSemaphore
  bool memory_budget = false;          ///< the extension VK_EXT_memory_budget
  bool external_memory = false;        ///< the extension VK_KHR_external_memory_fd
  uint64_t resident_cap = UINT64_MAX;  ///< bytes of its memory for meshes that stay there, at most
  /// Keeps those of ours who borrow the queue apart.
  std::shared_ptr<std::mutex> queue_mutex = std::make_shared<std::mutex>();
  ReplaceCalls replace_calls = nullptr;
};

/// A device, ready to compute, with one queue. Any thread may use it. Must outlive all that is made with it.
class Device {
 public:
  /// Errors: unsupported (no loader, no driver, no such device, or what it lacks), device_lost, out_of_memory.
  static Result<std::unique_ptr<Device>> open(const OwnDevice& options = {});
  /// Errors: invalid_argument (a handle is missing, half a lock), unsupported (what the engine's device lacks).
  static Result<std::unique_ptr<Device>> borrow(const BorrowedDevice& engine);
  /// Of an own device: waits until it is idle. A borrowed one is left as it is.
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const { return info_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  const InstanceTable& instanceCalls() const { return instance_calls_; }
  const DeviceTable& calls() const { return calls_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return device_; }
  VkQueue queue() const { return queue_; }  ///< to be used under a QueueLock only
  uint32_t family() const { return family_; }
  bool borrowed() const { return !instance_; }
  const std::vector<uint32_t>& readers() const { return readers_; }  ///< BorrowedDevice::readers
  bool sharesBuffers() const {                                       ///< with families other than family()
    return std::any_of(readers_.begin(), readers_.end(), [this](uint32_t reader) { return reader != family_; });
  }
  bool memoryBudget() const { return memory_budget_; }      ///< VK_EXT_memory_budget is enabled
  bool externalMemory() const { return external_memory_; }  ///< BorrowedDevice::external_memory
  /// Warnings and errors of the validation layer so far; empty without it, and on a borrowed device.
  std::vector<std::string> messages() const;

 private:
  friend class QueueLock;
  Device() = default;
  Result<void> choose(const OwnDevice& options);
  void adopt(VkPhysicalDevice physical);
  Result<void> openDevice();
  Result<void> load(const ReplaceCalls& replace);

  std::unique_ptr<Instance> instance_;  // null: borrowed
  InstanceTable instance_calls_;
  DeviceTable calls_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  std::vector<uint32_t> readers_;
  bool memory_budget_ = false;
  bool external_memory_ = false;
  DeviceInfo info_;
  VkPhysicalDeviceLimits limits_{};
  std::shared_ptr<std::mutex> queue_mutex_ = std::make_shared<std::mutex>();
  void (*lock_)(void*) = nullptr;
  void (*unlock_)(void*) = nullptr;
  void* user_ = nullptr;
};

/// Keeps others of ours, and the engine, from the device's queue for as long as it lives.
class QueueLock {
 public:
  explicit QueueLock(Device& device) : device_(device), ours_(*device.queue_mutex_) {
    if (device_.lock_) device_.lock_(device_.user_);
  }
  ~QueueLock() {
    if (device_.unlock_) device_.unlock_(device_.user_);
  }
  QueueLock(const QueueLock&) = delete;
  QueueLock& operator=(const QueueLock&) = delete;

 private:
  Device& device_;
  std::scoped_lock<std::mutex> ours_;
};

}  // namespace sgm::vulkan
