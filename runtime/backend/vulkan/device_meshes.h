#pragma once
// Meshes that stay on the device: parts are copied from a batch's buffers, or uploaded from the host, to memory of
// their own, where the engine that owns the device draws them.

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
  uint64_t value() const { return value_; }  ///< of the queue: at this value the content is complete
  /// Whether the content is there or will be; false if the copy failed.
  bool there() const { return value_ != 0 && value_ != kNever; }

 private:
  friend class DeviceMeshes;
  std::shared_ptr<const void> owner_;  // kept alive, since it owns the memory
  DeviceMeshes& meshes_;
  Buffer buffer_;
  static constexpr uint64_t kNever = UINT64_MAX;
  uint64_t value_ = 0;
};

/// A part with the data for draw commands. Immutable.
class VulkanPart final : public DevicePart {
 public:
  VulkanPart(std::shared_ptr<const DeviceMemory> memory, VkDeviceSize draw, uint32_t vertices, uint32_t indices);
  BackendKind kind() const override { return BackendKind::vulkan; }
  bool there() const override { return memory_->there(); }

  VkBuffer buffer() const { return memory_->buffer().handle(); }
  // Bytes from the beginning of buffer().
  VkDeviceSize drawOffset() const { return draw_; }  ///< of draw(), which is in device memory, too
  VkDeviceSize vertexOffset() const;                 ///< a multiple of sizeof(Vertex)
  VkDeviceSize indexOffset() const;                  ///< a multiple of 4
  uint32_t vertexCount() const { return vertices_; }
  uint32_t indexCount() const { return indices_; }
  /// For binding the whole buffer, as vertices and as 32-bit indices.
  VkDrawIndexedIndirectCommand draw() const;
  const DeviceMemory& memory() const { return *memory_; }

 private:
  std::shared_ptr<const DeviceMemory> memory_;
  VkDeviceSize draw_;
  uint32_t vertices_, indices_;
};

/// The source of a copied part; empty without indices.
struct PartSource {
  BufferRange vertices, indices;
};
using PartSources = std::array<PartSource, kMeshParts>;  ///< in the order of DeviceParts

/// Parts with a place but no content yet.
struct PlacedParts {
  struct Part {
    size_t chunk, part;
    std::shared_ptr<const VulkanPart> placed;
  };
  std::vector<DeviceParts> chunks;  ///< all null for a chunk without memory
  std::vector<Part> parts;
  std::vector<std::shared_ptr<DeviceMemory>> memories;
};

/// Parts that are being copied.
struct KeptParts {
  std::vector<DeviceParts> chunks;
  uint64_t value = 0;  ///< of the queue: at this value the sources are no longer read
};

/// Thread-safe. The queue, memories and ring must outlive it and its parts.
class DeviceMeshes {
 public:
  /// memory: for the parts; staging: for uploads.
  DeviceMeshes(Queue& queue, Memory& memory, Memory& staging, CommandRing& ring)
      : queue_(queue), memory_(memory), staging_(staging), ring_(ring) {}

  /// Allocates memory for parts. Throws std::bad_alloc.
  PlacedParts place(const std::shared_ptr<const void>& owner, std::span<const PartSizes> chunks);
  /// Makes content that another API has finished writing to placed parts visible, from a value of the queue on. Errors:
  /// as CommandRing::submit. Throws std::bad_alloc.
  Result<void> acquire(const PlacedParts& placed);
  /// Never reuses this memory, since writes to it may still be running.
  static void abandon(const PlacedParts& placed) noexcept;

  /// Copies parts asynchronously. Returns one DeviceParts for each chunk: null for parts without a source, all null for
  /// a chunk without memory. Later submissions may write to the sources, but the host must not before their end. owner
  /// is kept alive and must own this object. Errors: as CommandRing::submit. Throws std::bad_alloc.
  Result<KeptParts> keep(const std::shared_ptr<const void>& owner, std::span<const PartSources> chunks);
  /// Uploads parts from the host, as Backend::upload; blocks until they are there. Errors: also those of
  /// Memory::buffer.
  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(const std::shared_ptr<const void>& owner,
                                                                std::span<const MeshPart* const> parts);

  /// Bytes of living parts, as counted by the memory.
  uint64_t bytes();
  const Queue& queue() const { return queue_; }

 private:
  friend class DeviceMemory;
  /// Frees the buffer once the queue has reached the value.
  void retire(Buffer&& buffer, uint64_t value) noexcept;
  using Retired = std::list<std::pair<uint64_t, Buffer>>;
  /// The queue's value for freeing buffers.
  uint64_t reached() const noexcept;
  /// Takes the buffers to free, to be destroyed after the mutex is released. Precondition: the mutex is held.
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
