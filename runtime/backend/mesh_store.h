#pragma once
// Memory on the drawing device for meshes that another API's device makes on the same GPU.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "base/shared_memory.h"

namespace sgm {

/// The size of a part; a part without indices gets no place.
struct PartSize {
  uint32_t vertices = 0, indices = 0;
};
using PartSizes = std::array<PartSize, kMeshParts>;  ///< in the order of DeviceParts

/// The place to which a part is written, in bytes from the beginning of its block.
struct PartPlace {
  size_t chunk = 0, part = 0;
  SharedBlock* block = nullptr;
  uint64_t vertices = 0, indices = 0;
};

/// Parts with a place but no content yet. If it is destroyed while `writing`, the end of the writing is unknown: its
/// memory is not reused before the store's end.
class Placement {
 public:
  Placement() = default;
  virtual ~Placement() = default;
  Placement(const Placement&) = delete;
  Placement& operator=(const Placement&) = delete;

  std::vector<DeviceParts> chunks;  ///< all null for a chunk without memory
  std::vector<PartPlace> parts;
  // For the writer:
  bool writing = false;                           ///< set before the first byte is written
  std::vector<std::shared_ptr<const void>> held;  ///< objects needed for writing, until it is done
};

/// Thread-safe. Its parts keep it alive.
class MeshStore {
 public:
  virtual ~MeshStore() = default;
  virtual const DeviceId& device() const = 0;
  /// Whether the drawing device is lost: then nothing is placed any more.
  virtual bool lost() const = 0;
  /// Throws std::bad_alloc.
  virtual std::unique_ptr<Placement> place(std::span<const PartSizes> chunks) = 0;
  /// Call after all content was written, and the writing was waited for: makes it readable for the drawing device. If
  /// it fails, the parts of the placement are on no device. Errors: out_of_memory, device_lost.
  virtual Result<void> publish(Placement& placement) noexcept = 0;
  /// As Backend::upload(), by the drawing device; its loss is not the other device's, and reported as unsupported.
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) = 0;
  /// Bytes of living parts.
  virtual uint64_t bytes() = 0;
};

}  // namespace sgm
