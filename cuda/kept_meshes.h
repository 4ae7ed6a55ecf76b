#pragma once
// Meshes that stay on the device, for the engine that lent its context: parts copied out of a batch's memory, or
// brought from the host, to memory of their own.

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

/// The memory of a chunk's parts, or of one that was brought. Its end gives it back, which must not come before
/// that of what the engine has the device do with it.
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
  const std::shared_ptr<const void> owner_;  // what the memory is outlived by
  KeptMeshes& meshes_;
  std::byte* const data_;
  const size_t bytes_;
};

/// A part in the device's memory. Immutable.
struct CudaPart final : DevicePart {
  BackendKind kind() const override { return BackendKind::cuda; }
  std::shared_ptr<const KeptMemory> memory;
  const Vertex* vertices = nullptr;   ///< the device's, at a multiple of 256 bytes
  const uint32_t* indices = nullptr;  ///< likewise
  uint32_t vertex_count = 0, index_count = 0;
};

/// Where a part lies before it is copied; nothing where it has no indices.
struct PartSource {
  const Vertex* vertices = nullptr;
  const uint32_t* indices = nullptr;
  uint32_t vertex_count = 0, index_count = 0;
};
using PartSources = std::array<PartSource, kMeshParts>;  ///< in the order of DeviceParts

/// Any thread may use it. Outlived by the device that it is given, and by its parts.
class KeptMeshes {
 public:
  /// cap: the most bytes; a mesh that would be beyond is not kept.
  static Result<std::unique_ptr<KeptMeshes>> create(Device& device, uint64_t cap);

  /// Copies parts by the stream, in its own time, from the device's memory, or where `from_host` from pinned memory:
  /// one DeviceParts a chunk, null where there is no source, and throughout a chunk that no memory is left for. They
  /// are there once the stream has been waited for, and must not end before. owner keeps alive what this is outlived
  /// by. Errors: as Stream::copy. Throws std::bad_alloc.
  Result<std::vector<DeviceParts>> keep(const std::shared_ptr<const void>& owner, Stream& stream,
                                        std::span<const PartSources> chunks, bool from_host = false);
  /// Brings parts from the host, as Backend::upload; returns when they are there.
  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(const std::shared_ptr<const void>& owner,
                                                                std::span<const MeshPart* const> parts);
  /// Of parts that have not ended.
  uint64_t bytes() const { return bytes_.load(); }
  const Device& device() const { return device_; }

 private:
  friend class KeptMemory;
  KeptMeshes(Device& device, uint64_t cap) : device_(device), cap_(cap) {}
  /// Null: there is no room. Errors: those of a device that is lost. Throws std::bad_alloc.
  Result<std::shared_ptr<const KeptMemory>> allocate(const std::shared_ptr<const void>& owner, Stream& stream,
                                                     size_t bytes);
  Result<DeviceParts> keepChunk(const std::shared_ptr<const void>& owner, Stream& stream, const PartSources& sources,
                                bool from_host);
  void free(std::byte* data, size_t bytes) noexcept;

  Device& device_;
  const uint64_t cap_;
  std::atomic<uint64_t> bytes_{0};
  std::mutex ending_mutex_, bringing_mutex_;
  std::unique_ptr<Stream> ending_;    ///< gives memory back
  std::unique_ptr<Stream> bringing_;  ///< copies from the host
  Memory staging_;
};

}  // namespace sgm::cuda
