#pragma once
// Memory shared by the devices of two APIs on one GPU.

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>

#include "base/result.h"

namespace sgm {

/// Identifies a GPU, equally in every API (VkPhysicalDeviceIDProperties::deviceUUID, cuDeviceGetUuid).
using DeviceId = std::array<uint8_t, 16>;

/// One allocation of the drawing device, which another API imports whole. Lives as long as any object is placed in it.
class SharedBlock {
 public:
  SharedBlock() = default;
  virtual ~SharedBlock() = default;
  SharedBlock(const SharedBlock&) = delete;
  SharedBlock& operator=(const SharedBlock&) = delete;

  virtual uint64_t bytes() const = 0;
  /// True if it must be imported as memory dedicated to one buffer.
  virtual bool dedicated() const = 0;
  /// A file descriptor of it, which the caller closes. Errors: out_of_memory, limit, unsupported, device_lost.
  virtual Result<int> descriptor() const = 0;
  std::mutex importing;            ///< guards `imported`
  std::shared_ptr<void> imported;  ///< the other API's latest import; destroyed with the block
};

}  // namespace sgm
