#pragma once
// Memory that two APIs' devices on one GPU have in common.

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>

#include "base/result.h"

namespace sgm {

/// Names a GPU, the same in every API (VkPhysicalDeviceIDProperties::deviceUUID, cuDeviceGetUuid).
using DeviceId = std::array<uint8_t, 16>;

/// One allocation of the device that draws, which another API imports whole. Lives as long as anything is placed in it.
class SharedBlock {
 public:
  SharedBlock() = default;
  virtual ~SharedBlock() = default;
  SharedBlock(const SharedBlock&) = delete;
  SharedBlock& operator=(const SharedBlock&) = delete;

  virtual uint64_t bytes() const = 0;
  /// Whether it has to be imported as memory dedicated to one buffer.
  virtual bool dedicated() const = 0;
  /// A file descriptor of it, the caller's to close. Errors: out_of_memory, limit, unsupported, device_lost.
  virtual Result<int> descriptor() const = 0;
  std::mutex importing;            ///< guards `imported`
  std::shared_ptr<void> imported;  ///< what the other API has made of it last; ends with the block
};

}  // namespace sgm
