#pragma once
// A device with all that is made on it, for as long as any batch of it or any mesh on it lives.

#include <memory>
#include <mutex>
#include <vector>

#include "backend/vulkan/device_meshes.h"
#include "backend/vulkan/mesher.h"
#include "backend/vulkan/vulkan_backend.h"

namespace sgm::vulkan {

/// The plan and the buffers of one submission.
struct Slot {
  explicit Slot(std::pmr::memory_resource* memory) : plan(memory) {}
  BatchPlan plan;
  BatchBuffers buffers;
  size_t first = 0;    ///< of the batch's jobs
  uint64_t value = 0;  ///< of the queue; 0: not submitted
  uint64_t kept = 0;   ///< of the queue: parts are copied out until then
  bool stuck = false;  ///< nobody could say that the device has done with it
};

/// Any thread may use it.
class Session {
 public:
  /// Errors: as options.open and what is made on the device.
  static Result<std::shared_ptr<Session>> open(const VulkanBackendOptions& options);
  /// Waits for the device.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// One that nobody uses; where a new one is made its plan has that memory. Throws std::bad_alloc.
  std::unique_ptr<Slot> takeSlot(std::pmr::memory_resource* of_plan);
  /// Gives back what takeSlot gave.
  void release(std::unique_ptr<Slot>& slot) noexcept;
  /// Waits until the queue has reached the value; a second time where the driver may have been out of memory.
  Result<bool> reach(uint64_t value) const;

  std::unique_ptr<Device> device;
  std::unique_ptr<Queue> queue;
  std::unique_ptr<Memory> memory;
  std::unique_ptr<CommandRing> ring;
  std::unique_ptr<PipelineCache> cache;  ///< null: pipelines are not kept
  std::unique_ptr<Mesher> mesher;
  std::unique_ptr<Memory> kept_memory;  ///< of meshes that stay; null where nobody could draw them
  std::unique_ptr<DeviceMeshes> kept;   ///< likewise

 private:
  Session() = default;

  std::mutex mutex_;
  size_t slots_ = 0;
  std::vector<std::unique_ptr<Slot>> idle_;   // with room for all that there are
  std::vector<std::unique_ptr<Slot>> stuck_;  // the device may use them still, to the end
};

}  // namespace sgm::vulkan
