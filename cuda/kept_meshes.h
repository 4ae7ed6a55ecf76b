#pragma once
// Meshes that stay in the device's memory, for an engine that owns the CUDA context. Each mesh part is copied from the
// memory of its batch, or uploaded from the host, to memory of its own.

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

/// Device memory of a chunk's mesh parts, or of one uploaded part. The destructor frees it; the engine must destroy the
/// object only after its own work that uses the memory has ended.
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
  const std::shared_ptr<const void> owner_;  // keeps `meshes_` alive
  KeptMeshes& meshes_;
  std::byte* const data_;
  const size_t bytes_;
};

/// A mesh part in the device's memory. Immutable.
struct CudaPart final : DevicePart {
  BackendKind kind() const override { return BackendKind::cuda; }
  std::shared_ptr<const KeptMemory> memory;
  const Vertex* vertices = nullptr;   ///< vertices in device memory, aligned to 256 bytes
  const uint32_t* indices = nullptr;  ///< indices in device memory, aligned to 256 bytes
  uint32_t vertex_count = 0, index_count = 0;
};

/// The arrays from which a mesh part is copied; empty for a part without indices.
struct PartSource {
  const Vertex* vertices = nullptr;
  const uint32_t* indices = nullptr;
  uint32_t vertex_count = 0, index_count = 0;
};
using PartSources = std::array<PartSource, kMeshParts>;  ///< the parts of one chunk, in the order of DeviceParts

/// Allocates and fills device memory for mesh parts, up to a limit. Thread-safe. The device must outlive this object
/// and its parts.
class KeptMeshes {
 public:
  /// cap: limit in bytes; parts beyond it do not stay on the device.
  static Result<std::unique_ptr<KeptMeshes>> create(Device& device, uint64_t cap);

  /// Enqueues copies of mesh parts in the stream: from device memory or, if `from_host`, from pinned memory. Returns
  /// one DeviceParts for each chunk. A part is null if it has no source; all parts of a chunk are null if there is too
  /// little memory for it. The parts are complete when the stream's work has ended, and must not be destroyed before.
  /// owner: must own this object; the parts keep it alive. Errors: those of Stream::copy. Throws std::bad_alloc.
  Result<std::vector<DeviceParts>> keep(const std::shared_ptr<const void>& owner, Stream& stream,
                                        std::span<const PartSources> chunks, bool from_host = false);
  /// Uploads mesh parts from the host as Backend::upload does; blocks until they are on the device.
  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(const std::shared_ptr<const void>& owner,
                                                                std::span<const MeshPart* const> parts);
  /// Returns the total device memory of the existing parts in bytes.
  uint64_t bytes() const { return bytes_.load(); }
  const Device& device() const { return device_; }

 private:
  friend class KeptMemory;
  KeptMeshes(Device& device, uint64_t cap) : device_(device), cap_(cap) {}
  /// Allocates device memory; null if there is too little. Errors: those of a lost device. Throws std::bad_alloc.
  Result<std::shared_ptr<const KeptMemory>> allocate(const std::shared_ptr<const void>& owner, Stream& stream,
                                                     size_t bytes);
  Result<DeviceParts> keepChunk(const std::shared_ptr<const void>& owner, Stream& stream, const PartSources& sources,
                                bool from_host);
  void free(std::byte* data, size_t bytes) noexcept;

  Device& device_;
  const uint64_t cap_;
  std::atomic<uint64_t> bytes_{0};
  std::mutex ending_mutex_, uploading_mutex_;
  std::unique_ptr<Stream> ending_;     ///< the stream in which the parts' memory is freed
  std::unique_ptr<Stream> uploading_;  ///< the stream for copies from host to device
  Memory staging_;
};

}  // namespace sgm::cuda
