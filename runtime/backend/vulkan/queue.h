#pragma once
// Work for the device's queue, and when it ends: a timeline semaphore counts what was submitted.

#include <atomic>
#include <cstdint>
#include <memory>

#include "backend/vulkan/device.h"

namespace sgm::vulkan {

/// Submissions have the values 1, 2, 3... and end in this order. Any thread may use it. Outlived by its device.
///
/// Once any call has said device_lost, all later ones do: what was submitted may never end, and its results are lost.
class Queue {
 public:
  /// Errors: out_of_memory.
  static Result<std::unique_ptr<Queue>> create(Device& device);
  /// Waits for all that was submitted.
  ~Queue();
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;

  /// Its value, which is reached when the commands have ended and what they wrote is there. The command buffer must
  /// stay as it is until then. Errors: out_of_memory, where nothing was submitted; device_lost.
  Result<uint64_t> submit(VkCommandBuffer commands);

  /// Whether the value was reached, after at most so many nanoseconds; 0 only asks. Errors: device_lost, out_of_memory,
  /// invalid_argument (a value that was not submitted).
  Result<bool> wait(uint64_t value, uint64_t nanoseconds = UINT64_MAX) const;

  /// The value reached so far. Never blocks. Error: device_lost, out_of_memory.
  Result<uint64_t> reached() const;

  /// The value of the last submission; 0: none.
  uint64_t submitted() const { return submitted_.load(); }
  /// Waits for all that was submitted; a lost device does not make us wait. After it nothing of ours is in use.
  void drain() const;
  bool lost() const { return lost_.load(); }

  /// For an engine that waits on its own queue for what ours made.
  VkSemaphore semaphore() const { return semaphore_; }
  Device& device() const { return device_; }

 private:
  explicit Queue(Device& device) : device_(device) {}
  Error failed(VkResult result, const char* what) const;

  Device& device_;
  VkSemaphore semaphore_ = VK_NULL_HANDLE;
  std::atomic<uint64_t> submitted_{0};
  mutable std::atomic<bool> lost_{false};
};

}  // namespace sgm::vulkan
