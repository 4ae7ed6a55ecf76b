#pragma once
// Memory of the device that draws, for meshes that a device of another API writes on the same GPU.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "base/shared_memory.h"

namespace sgm {

/// The sizes of a part; a part without indices needs no memory.
struct PartSize {
  uint32_t vertices = 0, indices = 0;
};
using PartSizes = std::array<PartSize, kMeshParts>;  ///< in the order of DeviceParts

/// Where a part is to be written: offsets in bytes from the beginning of its block.
struct PartPlace {
  size_t chunk = 0, part = 0;
  SharedBlock* block = nullptr;
  uint64_t vertices = 0, indices = 0;
};

/// Parts that have memory but no content yet. If the object is destroyed while `writing`, it is unknown when the
/// writing ends: the memory is then not reused before the store is destroyed.
class Placement {
 public:
  Placement() = default;
  virtual ~Placement() = default;
  Placement(const Placement&) = delete;
  Placement& operator=(const Placement&) = delete;

  std::vector<DeviceParts> chunks;  ///< all parts are null for a chunk that got no memory
  std::vector<PartPlace> parts;
  // The following members are for the writer.
  bool writing = false;                           ///< must be set before the first byte is written
  std::vector<std::shared_ptr<const void>> held;  ///< objects that must exist until the writing ends
};

/// Thread-safe. The parts in it keep it alive.
class MeshStore {
 public:
  virtual ~MeshStore() = default;
  virtual const DeviceId& device() const = 0;
  /// True if the drawing device is lost: then no memory is given out any more.
  virtual bool lost() const = 0;
  /// Allocates memory for parts. Throws std::bad_alloc.
  virtual std::unique_ptr<Placement> place(std::span<const PartSizes> chunks) = 0;
  /// Makes content readable for the drawing device. Call after all content was written, and after waiting for the
  /// writes. If it fails, the parts of the placement are on no device. Errors: out_of_memory, device_lost.
  virtual Result<void> publish(Placement& placement) noexcept = 0;
  /// Same as Backend::upload(), on the drawing device. If that device is lost, the error is unsupported, because the
  /// other device is not lost.
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) = 0;
  /// Returns the size of the existing parts in bytes.
  virtual uint64_t bytes() = 0;
};

}  // namespace sgm
