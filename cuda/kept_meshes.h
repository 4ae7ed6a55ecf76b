#pragma once
// Meshes that stay on the device, for the engine that owns the context: parts are copied from a batch's memory, or
// uploaded from the host, to memory of their own.

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

/// The memory of a chunk's parts, or of an uploaded part. Its destructor frees the memory, and must run after the
/// engine's own work with it has ended.
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
  const std::shared_ptr<const void> owner_;  // kept alive, since it owns the memory
  KeptMeshes& meshes_;
  std::byte* const data_;
  const size_t bytes_;
};

/// A part in the device's memory. Immutable.
struct CudaPart final : DevicePart {
  BackendKind kind() const override { return BackendKind::cuda; }
  std::shared_ptr<const KeptMemory> memory;
  const Vertex* vertices = nullptr;   ///< in device memory, aligned to 256 bytes
  const uint32_t* indices = nullptr;  ///< same as above
  uint32_t vertex_count = 0, index_count = 0;
};

/// The source of a copied part; empty without indices.
struct PartSource {
  const Vertex* vertices = nullptr;
  const uint32_t* indices = nullptr;
  uint32_t vertex_count = 0, index_count = 0;
};
using PartSources = std::array<PartSource, kMeshParts>;  ///< in the order of DeviceParts

/// Thread-safe. The device must outlive it and its parts.
class KeptMeshes {
 public:
  /// cap: limit in bytes; meshes beyond it are not kept.
  static Result<std::unique_ptr<KeptMeshes>> create(Device& device, uint64_t cap);

  /// Copies parts asynchronously in the stream, from device memory or, if `from_host`, from pinned memory. Returns one
  /// DeviceParts for each chunk: null for parts without a source, all null for a chunk without memory. The parts are
  /// complete once the stream was waited for, and must live until then. owner is kept alive and must own this object.
  /// Errors: as Stream::copy. Throws std::bad_alloc.
  Result<std::vector<DeviceParts>> keep(const std::shared_ptr<const void>& owner, Stream& stream,
                                        std::span<const PartSources> chunks, bool from_host = false);
  /// Uploads parts from the host, as Backend::upload; blocks until they are there.
  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(const std::shared_ptr<const void>& owner,
                                                                std::span<const MeshPart* const> parts);
  /// Bytes of living parts.
  uint64_t bytes() const { return bytes_.load(); }
  const Device& device() const { return device_; }

 private:
  friend class KeptMemory;
  KeptMeshes(Device& device, uint64_t cap) : device_(device), cap_(cap) {}
  /// Null if there is no room. Errors: those of a lost device. Throws std::bad_alloc.
  Result<std::shared_ptr<const KeptMemory>> allocate(const std::shared_ptr<const void>& owner, Stream& stream,
                                                     size_t bytes);
  Result<DeviceParts> keepChunk(const std::shared_ptr<const void>& owner, Stream& stream, const PartSources& sources,
                                bool from_host);
  void free(std::byte* data, size_t bytes) noexcept;

  Device& device_;
  const uint64_t cap_;
  std::atomic<uint64_t> bytes_{0};
  std::mutex ending_mutex_, bringing_mutex_;
  std::unique_ptr<Stream> ending_;    ///< frees memory
  std::unique_ptr<Stream> bringing_;  ///< copies from the host
  Memory staging_;
};

}  // namespace sgm::cuda
