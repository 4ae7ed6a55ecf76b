#pragma once
// Meshes that stay on the device, for the engine that owns the context. Parts are copied from a batch's memory, or
// uploaded from the host, to separate memory.

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "cuda/device.h"

namespace sgm::cuda {

class KeptMeshes;

/// The memory of a chunk's parts, or of one uploaded part. The destructor frees the memory, and must run after the
/// engine's own work that uses it has ended.
class KeptMemory {
 public:
  KeptMemory(std::shared_ptr<const void> owner, KeptMeshes& meshes, std::byte* data, size_t bytes)
      : owner_(std::move(owner)), meshes_(meshes), data_(data), bytes_(bytes) {}
  ~KeptMemory();
  KeptMemory(const KeptMemory&) = delete;
  KeptMemory& operator=(const KeptMemory&) = delete;
  std::byte* data() const { return data_; }
  size_t bytes() const { return bytes_; }
  const KeptMeshes& meshes() const { return meshes_; }

 private:
  const std::shared_ptr<const void> owner_;  // kept alive, because it owns the memory
  KeptMeshes& meshes_;
  std::byte* const data_;
  const size_t bytes_;
};

/// A part in the device's memory. Immutable.
struct CudaPart final : DevicePart {
  BackendKind kind() const override { return BackendKind::cuda; }
  std::shared_ptr<const KeptMemory> memory;
  const Vertex* vertices = nullptr;   ///< in device memory, aligned to 256 bytes
  const uint32_t* indices = nullptr;  ///< in device memory, aligned to 256 bytes
  uint32_t vertex_count = 0, index_count = 0;
};

/// Where a part is copied from; empty for a part without indices.
struct PartSource {
  const Vertex* vertices = nullptr;
  const uint32_t* indices = nullptr;
  uint32_t vertex_count = 0, index_count = 0;
};
using PartSources = std::array<PartSource, kMeshParts>;  ///< in the order of DeviceParts

/// Thread-safe. The device must outlive this object and its parts.
class KeptMeshes {
 public:
  /// cap: limit in bytes; parts beyond it are not kept on the device.
  static Result<std::unique_ptr<KeptMeshes>> create(Device& device, uint64_t cap);

  /// Copies parts asynchronously in the stream: from device memory or, if `from_host`, from pinned memory. Returns one
  /// DeviceParts for each chunk: null for parts without a source; all null for a chunk for which there is no memory.
  /// The parts are complete when the stream's work has ended, and must exist until then. owner is kept alive and must
  /// own this object. Errors: same as Stream::copy. Throws std::bad_alloc.
  Result<std::vector<DeviceParts>> keep(const std::shared_ptr<const void>& owner, Stream& stream,
                                        std::span<const PartSources> chunks, bool from_host = false);
  /// Uploads parts from the host, as Backend::upload does; blocks until they are on the device.
  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(const std::shared_ptr<const void>& owner,
                                                                std::span<const MeshPart* const> parts);
  /// Returns the size of the existing parts in bytes.
  uint64_t bytes() const { return bytes_.load(); }
  const Device& device() const { return device_; }

 private:
  friend class KeptMemory;
  KeptMeshes(Device& device, uint64_t cap) : device_(device), cap_(cap) {}
  /// Allocates memory; null if there is too little. Errors: those of a lost device. Throws std::bad_alloc.
  Result<std::shared_ptr<const KeptMemory>> allocate(const std::shared_ptr<const void>& owner, Stream& stream,
                                                     size_t bytes);
  Result<DeviceParts> keepChunk(const std::shared_ptr<const void>& owner, Stream& stream, const PartSources& sources,
                                bool from_host);
  void free(std::byte* data, size_t bytes) noexcept;

  Device& device_;
  const uint64_t cap_;
  std::atomic<uint64_t> bytes_{0};
  std::mutex ending_mutex_, downloading_mutex_;
  std::unique_ptr<Stream> ending_;       ///< the stream in which memory is freed
  std::unique_ptr<Stream> downloading_;  ///< the stream for copies from the host
  Memory staging_;
};

}  // namespace sgm::cuda
