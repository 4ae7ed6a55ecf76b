#pragma once
// Memory of the device that draws, for meshes that another API's device makes on the same GPU.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "base/shared_memory.h"

namespace sgm {

/// How large a part is; nothing is placed where it has no indices.
struct PartSize {
  uint32_t vertices = 0, indices = 0;
};
using PartSizes = std::array<PartSize, kMeshParts>;  ///< in the order of DeviceParts

/// Where a part is to be written, in bytes from the beginning of its block.
struct PartPlace {
  size_t chunk = 0, part = 0;
  SharedBlock* block = nullptr;
  uint64_t vertices = 0, indices = 0;
};

/// Parts that have a place, and no content yet. Where one ends in writing nobody knows when that will be over: its
/// memory is not used again before the store's end.
class Placement {
 public:
  Placement() = default;
  virtual ~Placement() = default;
  Placement(const Placement&) = delete;
  Placement& operator=(const Placement&) = delete;

  std::vector<DeviceParts> chunks;  ///< null throughout a chunk that no memory is left for
  std::vector<PartPlace> parts;
  // Of whoever writes:
  bool writing = false;                           ///< from before the first byte on
  std::vector<std::shared_ptr<const void>> held;  ///< what it writes through, until that is over
};

/// Any thread may use it. Its parts keep it alive.
class MeshStore {
 public:
  virtual ~MeshStore() = default;
  virtual const DeviceId& device() const = 0;
  /// Whether the device that draws is lost: nothing is placed any more.
  virtual bool lost() const = 0;
  /// Throws std::bad_alloc.
  virtual std::unique_ptr<Placement> place(std::span<const PartSizes> chunks) = 0;
  /// Once all content has been written, and the writing been waited for: lets the device that draws read it. Parts of a
  /// placement that could not be published are on no device. Errors: out_of_memory, device_lost.
  virtual Result<void> publish(Placement& placement) noexcept = 0;
  /// As Backend::upload(): by the device that draws, whose loss is none of the other's (unsupported).
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) = 0;
  /// Of parts that have not ended.
  virtual uint64_t bytes() = 0;
};

}  // namespace sgm
