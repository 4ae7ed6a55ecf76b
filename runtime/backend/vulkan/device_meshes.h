#pragma once
// Meshes that stay on the device. Parts are copied from a batch's buffers, or uploaded from the host, to separate
// memory, where the engine that owns the device draws them.

#include <array>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "backend/backend.h"
#include "backend/mesh_store.h"
#include "backend/vulkan/commands.h"

namespace sgm::vulkan {

class DeviceMeshes;

/// The memory of parts that were copied together. It may be destroyed before the copying ends, but not before the
/// engine's own commands that use it have ended.
class DeviceMemory {
 public:
  DeviceMemory(std::shared_ptr<const void> owner, DeviceMeshes& meshes, Buffer&& buffer)
      : owner_(std::move(owner)), meshes_(meshes), buffer_(std::move(buffer)) {}
  ~DeviceMemory();
  DeviceMemory(const DeviceMemory&) = delete;
  DeviceMemory& operator=(const DeviceMemory&) = delete;

  const Buffer& buffer() const { return buffer_; }
  const DeviceMeshes& meshes() const { return meshes_; }
  uint64_t value() const { return value_; }  ///< timeline value of the queue at which the content is complete
  /// True if the content is complete or will be; false if the copy failed.
  bool there() const { return value_ != 0 && value_ != kNever; }

 private:
  friend class DeviceMeshes;
  std::shared_ptr<const void> owner_;  // object that owns the memory, kept alive
  DeviceMeshes& meshes_;
  Buffer buffer_;
  static constexpr uint64_t kNever = UINT64_MAX;
  uint64_t value_ = 0;
};

/// A part on the device, with the data that draw commands need. Immutable.
class VulkanPart final : public DevicePart {
 public:
  VulkanPart(std::shared_ptr<const DeviceMemory> memory, VkDeviceSize draw, uint32_t vertices, uint32_t indices);
  BackendKind kind() const override { return BackendKind::vulkan; }
  bool there() const override { return memory_->there(); }

  VkBuffer buffer() const { return memory_->buffer().handle(); }
  // All offsets below are in bytes from the beginning of buffer().
  VkDeviceSize drawOffset() const { return draw_; }  ///< offset of the draw command, which is also in device memory
  VkDeviceSize vertexOffset() const;                 ///< offset of the vertices; a multiple of sizeof(Vertex)
  VkDeviceSize indexOffset() const;                  ///< offset of the indices; a multiple of 4
  uint32_t vertexCount() const { return vertices_; }
  uint32_t indexCount() const { return indices_; }
  /// Returns the draw command for binding the whole buffer, both as vertices and as 32-bit indices.
  VkDrawIndexedIndirectCommand draw() const;
  const DeviceMemory& memory() const { return *memory_; }

 private:
  std::shared_ptr<const DeviceMemory> memory_;
  VkDeviceSize draw_;
  uint32_t vertices_, indices_;
};

/// The ranges that a part is copied from; empty for a part without indices.
struct PartSource {
  BufferRange vertices, indices;
};
using PartSources = std::array<PartSource, kMeshParts>;  ///< in the order of DeviceParts

/// Parts that have memory but no content yet.
struct PlacedParts {
  struct Part {
    size_t chunk, part;
    std::shared_ptr<const VulkanPart> placed;
  };
  std::vector<DeviceParts> chunks;  ///< all parts are null for a chunk that got no memory
  std::vector<Part> parts;
  std::vector<std::shared_ptr<DeviceMemory>> memories;
};

/// Parts whose copying has been submitted.
struct KeptParts {
  std::vector<DeviceParts> chunks;
  uint64_t value = 0;  ///< timeline value of the queue at which the last read of the sources has ended
};

/// The meshes that stay on one device. Thread-safe. The queue, memories and ring must outlive this object and its
/// parts.
class DeviceMeshes {
 public:
  /// memory: for the parts; staging: for the data of uploads.
  DeviceMeshes(Queue& queue, Memory& memory, Memory& staging, CommandRing& ring)
      : queue_(queue), memory_(memory), staging_(staging), ring_(ring) {}

  /// Allocates memory for parts. owner: stored in the parts to keep it alive. Throws std::bad_alloc.
  PlacedParts place(const std::shared_ptr<const void>& owner, std::span<const PartSizes> chunks);
  /// Makes content that another API has finished writing into placed parts visible to later commands of the queue.
  /// Errors: same as CommandRing::submit. Throws std::bad_alloc.
  Result<void> acquire(const PlacedParts& placed);
  /// Never frees the memory of the parts, because another API may still be writing to it.
  static void abandon(const PlacedParts& placed) noexcept;

  /// Copies parts asynchronously. Returns one DeviceParts for each chunk: null for parts without a source; all null for
  /// a chunk for which there is no memory. Later submissions may write to the sources, but the host must not before the
  /// copying ends. owner is kept alive and must own this object. Errors: same as CommandRing::submit. Throws
  /// std::bad_alloc.
  Result<KeptParts> keep(const std::shared_ptr<const void>& owner, std::span<const PartSources> chunks);
  /// Uploads parts from the host, as Backend::upload does; blocks until they are on the device. Errors: those of keep()
  /// and of Memory::buffer.
  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(const std::shared_ptr<const void>& owner,
                                                                std::span<const MeshPart* const> parts);

  /// Returns the size of the existing parts in bytes, as counted by the memory.
  uint64_t bytes();
  const Queue& queue() const { return queue_; }

 private:
  friend class DeviceMemory;
  /// Frees the buffer when the queue has reached the timeline value.
  void retire(Buffer&& buffer, uint64_t value) noexcept;
  using Retired = std::list<std::pair<uint64_t, Buffer>>;
  /// Returns the timeline value that the queue has reached, for freeing buffers.
  uint64_t reached() const noexcept;
  /// Removes the buffers that can be freed from the list; the caller destroys them after releasing the mutex.
  /// Precondition: the mutex is held.
  Retired takeEnded() noexcept;
  void giveBack() noexcept;

  Queue& queue_;
  Memory& memory_;
  Memory& staging_;
  CommandRing& ring_;
  std::mutex mutex_;
  Retired retired_;
};

}  // namespace sgm::vulkan
