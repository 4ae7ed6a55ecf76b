#pragma once
// Memory that devices of two APIs (Vulkan and CUDA) on one GPU share.

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>

#include "base/result.h"

namespace sgm {

/// Identifies a GPU; the same value in every API (VkPhysicalDeviceIDProperties::deviceUUID, cuDeviceGetUuid).
using DeviceId = std::array<uint8_t, 16>;

/// One allocation of the device that draws, which the other API imports as a whole. Lives as long as any object in its
/// memory.
class SharedBlock {
 public:
  SharedBlock() = default;
  virtual ~SharedBlock() = default;
  SharedBlock(const SharedBlock&) = delete;
  SharedBlock& operator=(const SharedBlock&) = delete;

  virtual uint64_t bytes() const = 0;
  /// True if the other API must import the memory as dedicated to one buffer.
  virtual bool dedicated() const = 0;
  /// A file descriptor of the memory, which the caller closes. Errors: out_of_memory, limit, unsupported, device_lost.
  virtual Result<int> descriptor() const = 0;
  std::mutex importing;            ///< guards `imported`
  std::shared_ptr<void> imported;  ///< the other API's latest import; destroyed with the block
};

}  // namespace sgm
