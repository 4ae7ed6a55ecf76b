#pragma once
// The device of the Vulkan backend: created by the library, or the engine's (external).

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "backend/vulkan/devices.h"

namespace sgm::vulkan {

/// May replace entries of the device's function table before the first call; tests use it to make calls fail.
using ReplaceCalls = std::function<void(DeviceTable&)>;

struct OwnDevice {
  int index = -1;         ///< index in listDevices(); -1: the usable device of the fastest type
  bool software = false;  ///< if index is -1: accept a software device if there is no hardware device
  Validation validation = Validation::none;
  std::shared_ptr<MessageLog> log = nullptr;  ///< same as InstanceOptions::log
  std::function<void(InstanceTable&)> replace_instance_calls = nullptr;
  ReplaceCalls replace_calls = nullptr;
};

/// An engine's device. All handles must outlive the Device that uses them.
struct BorrowedDevice {
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t family = 0;            ///< index of the queue's family
  std::vector<uint32_t> readers;  ///< queue families of the engine's other queues that read meshes
  /// Called before and after every use of the queue, on the submitting thread. Set both or neither; null: only the
  /// library uses the queue.
  void (*lock)(void* user) = nullptr;
  void (*unlock)(void* user) = nullptr;
  void* user = nullptr;
  // Features that the engine has enabled; Vulkan does not report which ones are enabled.
  uint32_t api_version = 0;            ///< VkApplicationInfo::apiVersion
  bool timeline_semaphores = false;    ///< true: the feature timelineSemaphore is enabled
  bool memory_budget = false;          ///< true: the extension VK_EXT_memory_budget is enabled
  bool external_memory = false;        ///< true: the extension VK_KHR_external_memory_fd is enabled
  uint64_t resident_cap = UINT64_MAX;  ///< limit in bytes for meshes that stay in the device's memory
  /// Held while the library uses the queue, so that its threads use the queue one at a time.
  std::shared_ptr<std::mutex> queue_mutex = std::make_shared<std::mutex>();
  ReplaceCalls replace_calls = nullptr;
};

/// An open device with one queue. Thread-safe. Must outlive everything created with it.
class Device {
 public:
  /// Creates a device. Errors: unsupported (no loader, driver or device, or a missing feature), device_lost,
  /// out_of_memory.
  static Result<std::unique_ptr<Device>> open(const OwnDevice& options = {});
  /// Uses the engine's device. Errors: invalid_argument (a handle is missing, or only one of lock and unlock is set),
  /// unsupported (a feature is missing).
  static Result<std::unique_ptr<Device>> borrow(const BorrowedDevice& engine);
  /// Waits until the library's own device is idle; does nothing with an external one.
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const { return info_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  const InstanceTable& instanceCalls() const { return instance_calls_; }
  const DeviceTable& calls() const { return calls_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return device_; }
  VkQueue queue() const { return queue_; }  ///< use only under a QueueLock
  uint32_t family() const { return family_; }
  bool borrowed() const { return !instance_; }
  const std::vector<uint32_t>& readers() const { return readers_; }  ///< BorrowedDevice::readers
  /// true if buffers are shared with families other than family()
  bool sharesBuffers() const {
    return std::any_of(readers_.begin(), readers_.end(), [this](uint32_t reader) { return reader != family_; });
  }
  bool memoryBudget() const { return memory_budget_; }      ///< true if VK_EXT_memory_budget is enabled
  bool externalMemory() const { return external_memory_; }  ///< true if BorrowedDevice::external_memory is set
  /// Returns the warnings and errors of the validation layer so far; empty without the layer, and for an external
  /// device.
  std::vector<std::string> messages() const;

 private:
  friend class QueueLock;
  Device() = default;
  Result<void> choose(const OwnDevice& options);
  void adopt(VkPhysicalDevice physical);
  Result<void> openDevice();
  Result<void> load(const ReplaceCalls& replace);

  std::unique_ptr<Instance> instance_;  // null if the device is external
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

/// Holds the device's queue locked as long as this object exists, so that neither the library nor the engine uses it on
/// another thread.
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
