#pragma once
// Meshes that stay on the device. Their parts are copied from a batch's buffers, or uploaded from the host, to memory
// of their own. The engine, which owns the device, draws them from there.

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

/// The memory of parts that were copied together. This object may be destroyed before the copying ends, but not before
/// the engine's own commands that use the memory have ended.
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
  /// Returns the draw command. It requires that the whole buffer is bound twice: as vertex buffer, and as buffer of
  /// 32-bit indices.
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
/// the sources of a chunk's parts, in the order of DeviceParts
using PartSources = std::array<PartSource, kMeshParts>;

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

  /// Allocates memory for parts. owner: the parts keep it alive. Throws std::bad_alloc.
  PlacedParts place(const std::shared_ptr<const void>& owner, std::span<const PartSizes> chunks);
  /// For placed parts whose content another API has finished writing: makes the content visible to later commands of
  /// the queue. Errors: same as CommandRing::submit. Throws std::bad_alloc.
  Result<void> acquire(const PlacedParts& placed);
  /// Gives placed parts up without ever freeing their memory, because another API may still be writing to it.
  static void abandon(const PlacedParts& placed) noexcept;

  /// Copies parts asynchronously. Returns one DeviceParts for each chunk: null for parts without a source; all null for
  /// a chunk for which there is no memory. Later submissions may overwrite the sources at once; the host must not
  /// overwrite them before the copying ends. owner is kept alive and must own this object. Errors: same as
  /// CommandRing::submit. Throws std::bad_alloc.
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
  /// Keeps the buffer until the queue has reached the timeline value, then frees it. Never frees it if the value is
  /// DeviceMemory::kNever.
  void retire(Buffer&& buffer, uint64_t value) noexcept;
  using Retired = std::list<std::pair<uint64_t, Buffer>>;
  /// Returns the timeline value that the queue has reached, for freeing buffers.
  uint64_t reached() const noexcept;
  /// Removes from the list the buffers that can be freed; the caller destroys them after releasing the mutex.
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
