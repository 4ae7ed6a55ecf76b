#pragma once
// Meshes that stay on the device: parts copied out of a batch's buffers, or brought from the host, to memory of their
// own, where the engine that lent the device draws them.

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

/// The memory of parts that were copied together. Its end may come before that of the copying; not before that of what
/// the engine has the device do with it.
class DeviceMemory {
 public:
  DeviceMemory(std::shared_ptr<const void> owner, DeviceMeshes& meshes, Buffer&& buffer)
      : owner_(std::move(owner)), meshes_(meshes), buffer_(std::move(buffer)) {}
  ~DeviceMemory();
  DeviceMemory(const DeviceMemory&) = delete;
  DeviceMemory& operator=(const DeviceMemory&) = delete;

  const Buffer& buffer() const { return buffer_; }
  const DeviceMeshes& meshes() const { return meshes_; }
  uint64_t value() const { return value_; }  ///< of the queue: from it on the content is there
  /// Whether it will be. Where not, nobody could bring it.
  bool there() const { return value_ != 0 && value_ != kNever; }

 private:
  friend class DeviceMeshes;
  std::shared_ptr<const void> owner_;  // what the memory is outlived by
  DeviceMeshes& meshes_;
  Buffer buffer_;
  static constexpr uint64_t kNever = UINT64_MAX;
  uint64_t value_ = 0;
};

/// A part as draw commands address it. Immutable.
class VulkanPart final : public DevicePart {
 public:
  VulkanPart(std::shared_ptr<const DeviceMemory> memory, VkDeviceSize draw, uint32_t vertices, uint32_t indices);
  BackendKind kind() const override { return BackendKind::vulkan; }
  bool there() const override { return memory_->there(); }

  VkBuffer buffer() const { return memory_->buffer().handle(); }
  // Bytes from the beginning of buffer().
  VkDeviceSize drawOffset() const { return draw_; }  ///< of draw(), likewise in the device's memory
  VkDeviceSize vertexOffset() const;                 ///< a multiple of sizeof(Vertex)
  VkDeviceSize indexOffset() const;                  ///< a multiple of 4
  uint32_t vertexCount() const { return vertices_; }
  uint32_t indexCount() const { return indices_; }
  /// With the buffer bound whole, as vertices and as 32-bit indices.
  VkDrawIndexedIndirectCommand draw() const;
  const DeviceMemory& memory() const { return *memory_; }

 private:
  std::shared_ptr<const DeviceMemory> memory_;
  VkDeviceSize draw_;
  uint32_t vertices_, indices_;
};

/// Where a part lies before it is copied; nothing where it has no indices.
struct PartSource {
  BufferRange vertices, indices;
};
using PartSources = std::array<PartSource, kMeshParts>;  ///< in the order of DeviceParts

/// Parts that have a place, and no content yet.
struct PlacedParts {
  struct Part {
    size_t chunk, part;
    std::shared_ptr<const VulkanPart> placed;
  };
  std::vector<DeviceParts> chunks;  ///< null throughout a chunk that no memory is left for
  std::vector<Part> parts;
  std::vector<std::shared_ptr<DeviceMemory>> memories;
};

/// Parts that are being copied.
struct KeptParts {
  std::vector<DeviceParts> chunks;
  uint64_t value = 0;  ///< of the queue: from it on the sources are not read any more
};

/// Any thread may use it. Outlived by the queue, memory and ring that it is given, and by its parts.
class DeviceMeshes {
 public:
  /// memory: of the parts; staging: of what comes from the host.
  DeviceMeshes(Queue& queue, Memory& memory, Memory& staging, CommandRing& ring)
      : queue_(queue), memory_(memory), staging_(staging), ring_(ring) {}

  /// Memory for parts. Throws std::bad_alloc.
  PlacedParts place(const std::shared_ptr<const void>& owner, std::span<const PartSizes> chunks);
  /// What another API has written to placed parts, and nobody writes to any more, is there from a value of the queue
  /// on. Errors: as CommandRing::submit. Throws std::bad_alloc.
  Result<void> acquire(const PlacedParts& placed);
  /// What may be written to still, for all that anybody knows, is kept from others until the end.
  static void abandon(const PlacedParts& placed) noexcept;

  /// Copies parts, in the device's own time: one DeviceParts a chunk, null where there is no source, and throughout a
  /// chunk that no memory is left for. Later submissions may write to the sources, the host may not before their end.
  /// owner keeps alive what this is outlived by. Errors: as CommandRing::submit. Throws std::bad_alloc.
  Result<KeptParts> keep(const std::shared_ptr<const void>& owner, std::span<const PartSources> chunks);
  /// Brings parts from the host, as Backend::upload; returns when they are there. Errors: also those of Memory::buffer.
  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(const std::shared_ptr<const void>& owner,
                                                                std::span<const MeshPart* const> parts);

  /// Of parts that have not ended, as the memory counts them.
  uint64_t bytes();
  const Queue& queue() const { return queue_; }

 private:
  friend class DeviceMemory;
  /// Gives the buffer back once the queue has reached the value.
  void retire(Buffer&& buffer, uint64_t value) noexcept;
  using Retired = std::list<std::pair<uint64_t, Buffer>>;
  /// Of the queue, for what is to be given back.
  uint64_t reached() const noexcept;
  /// What may be given back, to be ended when the mutex is not held any more. Precondition: it is.
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
