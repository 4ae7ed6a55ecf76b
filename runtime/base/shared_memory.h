#pragma once
// GPU memory that devices of two APIs (Vulkan and CUDA) share.

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>

#include "base/result.h"

namespace sgm {

/// Identifies a GPU; the same value in every API (VkPhysicalDeviceIDProperties::deviceUUID, cuDeviceGetUuid).
using DeviceId = std::array<uint8_t, 16>;

/// One memory allocation of the rendering device (Vulkan), which the other API (CUDA) imports as a whole. The block
/// exists as long as any object in its memory.
class SharedBlock {
 public:
  SharedBlock() = default;
  virtual ~SharedBlock() = default;
  SharedBlock(const SharedBlock&) = delete;
  SharedBlock& operator=(const SharedBlock&) = delete;

  virtual uint64_t bytes() const = 0;
  /// True if the importing API must treat the memory as dedicated to a single buffer.
  virtual bool dedicated() const = 0;
  /// Exports the memory as a file descriptor, which the caller must close. Errors: out_of_memory, limit, unsupported,
  /// device_lost.
  virtual Result<int> descriptor() const = 0;
  std::mutex importing;            ///< guards `imported`
  std::shared_ptr<void> imported;  ///< the importing API's latest import object; destroyed with this block
};

}  // namespace sgm
