#pragma once
// Memory of the drawing device, into which a device of another API (CUDA) on the same GPU writes meshes.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "base/shared_memory.h"

namespace sgm {

/// The numbers of vertices and indices of a part. A part without indices needs no memory.
struct PartSize {
  uint32_t vertices = 0, indices = 0;
};
using PartSizes = std::array<PartSize, kMeshParts>;  ///< the sizes of a chunk's parts, in the order of DeviceParts

/// The place where a part is to be written. Offsets are in bytes from the beginning of its block.
struct PartPlace {
  size_t chunk = 0, part = 0;
  SharedBlock* block = nullptr;
  uint64_t vertices = 0, indices = 0;
};

/// Parts that have memory but no content yet. If the object is destroyed while `writing` is true, it is unknown when
/// the writing ends. So the memory is not reused as long as the store exists.
class MeshPlacement {
 public:
  MeshPlacement() = default;
  virtual ~MeshPlacement() = default;
  MeshPlacement(const MeshPlacement&) = delete;
  MeshPlacement& operator=(const MeshPlacement&) = delete;

  std::vector<DeviceParts> chunks;  ///< the placed parts of each chunk; all null for a chunk that got no memory
  std::vector<PartPlace> parts;
  // The members below are set by the code that writes the content.
  /// true while content is written; must be set before the first byte is written
  bool writing = false;
  std::vector<std::shared_ptr<const void>> held;  ///< objects that must exist until the writing ends
};

/// Allocates memory of the drawing device for parts. The parts keep the store alive. Thread-safe.
class MeshStore {
 public:
  virtual ~MeshStore() = default;
  virtual const DeviceId& device() const = 0;
  /// Returns true if the drawing device is lost. The store then allocates no more memory.
  virtual bool lost() const = 0;
  /// Allocates memory for parts. Throws std::bad_alloc.
  virtual std::unique_ptr<MeshPlacement> place(std::span<const PartSizes> chunks) = 0;
  /// Makes the content of placed parts readable for the drawing device. Call after all content was written, and after
  /// waiting for the writes. After an error, the content of the placement's parts is on no device. Errors:
  /// out_of_memory, device_lost.
  virtual Result<void> publish(MeshPlacement& placement) noexcept = 0;
  /// Same as Backend::upload(), on the drawing device. If the drawing device is lost, the error is `unsupported`,
  /// because `device_lost` would mean the device that meshes.
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) = 0;
  /// Returns the size of the existing parts in bytes.
  virtual uint64_t bytes() = 0;
};

}  // namespace sgm
