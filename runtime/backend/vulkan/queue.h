#pragma once
// Submits work to the device's queue and tracks its end by a timeline semaphore that counts submissions.

#include <atomic>
#include <cstdint>
#include <memory>

#include "backend/vulkan/device.h"

namespace sgm::vulkan {

/// The device's queue. Its timeline semaphore gives submissions the values 1, 2, 3..., and submissions end in this
/// order. Thread-safe. The device must outlive the queue. Once a call has returned device_lost, all later calls return
/// device_lost: submitted work may never end, and its results are lost.
class Queue {
 public:
  /// Creates the queue. Errors: out_of_memory.
  static Result<std::unique_ptr<Queue>> create(Device& device);
  /// Waits for everything that was submitted.
  ~Queue();
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;

  /// Submits commands. Returns the timeline value of the submission, which is reached when the commands have ended and
  /// their writes are visible. The command buffer must not change until then. Errors: out_of_memory (nothing was
  /// submitted); device_lost.
  Result<uint64_t> submit(VkCommandBuffer commands);

  /// Waits at most this long for a timeline value; 0 only queries. Returns true if the value is reached. Errors:
  /// device_lost, out_of_memory, invalid_argument (the value was not submitted).
  Result<bool> wait(uint64_t value, uint64_t nanoseconds = UINT64_MAX) const;

  /// Returns the timeline value reached so far. Never blocks. Errors: device_lost, out_of_memory.
  Result<uint64_t> reached() const;

  /// Returns the timeline value of the last submission; 0: none.
  uint64_t submitted() const { return submitted_.load(); }
  /// Waits for all submissions, except those of a lost device. Afterwards the device uses no objects of the library.
  void drain() const;
  bool lost() const { return lost_.load(); }

  /// The timeline semaphore, for an engine whose own queue waits for results of the library.
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
