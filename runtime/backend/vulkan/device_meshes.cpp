#include "backend/vulkan/device_meshes.h"

#include <cstring>

namespace sgm::vulkan {
namespace {

/// A draw command, padded so that vertices behind it begin at a multiple of their size.
constexpr VkDeviceSize kDrawBytes = 2 * sizeof(Vertex);
static_assert(sizeof(VkDrawIndexedIndirectCommand) <= kDrawBytes);
// Buffers begin at multiples of 256 bytes, and lie in blocks that no draw command is too short to address.
static_assert(256 % sizeof(Vertex) == 0);
static_assert(MemoryOptions{}.largest_block / sizeof(Vertex) <= INT32_MAX);

VkDeviceSize bytesOf(const PartSource& part) {
  const VkDeviceSize bytes = kDrawBytes + part.vertices.size + part.indices.size;
  return (bytes + sizeof(Vertex) - 1) / sizeof(Vertex) * sizeof(Vertex);
}

VkDeviceSize bytesOf(const PartSources& parts) {
  VkDeviceSize bytes = 0;
  for (const PartSource& part : parts) bytes += part.indices.size > 0 ? bytesOf(part) : 0;
  return bytes;
}

void copyPart(Commands& commands, const PartSource& source, const VulkanPart& part) {
  const Buffer& buffer = part.memory().buffer();
  const auto within = [&](VkDeviceSize offset, VkDeviceSize bytes) {
    return BufferRange(buffer, offset - buffer.offset(), bytes);
  };
  const VkDrawIndexedIndirectCommand draw = part.draw();
  commands.write(within(part.drawOffset(), sizeof draw), std::as_bytes(std::span(&draw, 1)));
  commands.copy(source.vertices, within(part.vertexOffset(), source.vertices.size));
  commands.copy(source.indices, within(part.indexOffset(), source.indices.size));
}

}  // namespace

DeviceMemory::~DeviceMemory() { meshes_.retire(std::move(buffer_), value_); }

VulkanPart::VulkanPart(std::shared_ptr<const DeviceMemory> memory, VkDeviceSize draw, uint32_t vertices,
                       uint32_t indices)
    : memory_(std::move(memory)), draw_(draw), vertices_(vertices), indices_(indices) {}

VkDeviceSize VulkanPart::vertexOffset() const { return draw_ + kDrawBytes; }

VkDeviceSize VulkanPart::indexOffset() const { return vertexOffset() + vertices_ * VkDeviceSize{sizeof(Vertex)}; }

VkDrawIndexedIndirectCommand VulkanPart::draw() const {
  VkDrawIndexedIndirectCommand command{};
  command.indexCount = indices_;
  command.instanceCount = 1;
  command.firstIndex = static_cast<uint32_t>(indexOffset() / sizeof(uint32_t));
  command.vertexOffset = static_cast<int32_t>(vertexOffset() / sizeof(Vertex));
  return command;
}

Result<KeptParts> DeviceMeshes::keep(const std::shared_ptr<const void>& owner, std::span<const PartSources> chunks) {
  {
    const std::scoped_lock lock(mutex_);
    collect();
  }
  KeptParts kept{std::vector<DeviceParts>(chunks.size())};
  std::vector<std::shared_ptr<DeviceMemory>> memories;
  struct Copy {
    const PartSource& source;
    std::shared_ptr<const VulkanPart> part;
  };
  std::vector<Copy> copies;
  for (size_t c = 0; c < chunks.size(); ++c) {
    const VkDeviceSize bytes = bytesOf(chunks[c]);
    if (bytes == 0) continue;
    Result<Buffer> buffer = memory_.buffer(MemoryKind::device, bytes);
    if (!buffer) continue;
    memories.push_back(std::make_shared<DeviceMemory>(owner, *this, std::move(*buffer)));
    VkDeviceSize draw = memories.back()->buffer().offset();
    for (size_t p = 0; p < chunks[c].size(); ++p) {
      const PartSource& source = chunks[c][p];
      if (source.indices.size == 0) continue;
      const auto vertices = static_cast<uint32_t>(source.vertices.size / sizeof(Vertex));
      const auto indices = static_cast<uint32_t>(source.indices.size / sizeof(uint32_t));
      copies.push_back({source, std::make_shared<const VulkanPart>(memories.back(), draw, vertices, indices)});
      kept.chunks[c][p] = copies.back().part;
      draw += bytesOf(source);
    }
  }
  if (copies.empty()) return kept;
  // Others wait for a recording: none is held any longer than it takes.
  Result<Commands> commands = ring_.begin();
  if (!commands) return commands.error();
  // Shaders wrote the sources.
  commands->barrier(kCompute, kTransfer);
  for (const Copy& copy : copies) copyPart(*commands, copy.source, *copy.part);
  commands->barrier(kTransfer, kCompute);
  const Result<uint64_t> value = ring_.submit(std::move(*commands));
  if (!value) return value.error();
  kept.value = *value;
  for (const auto& memory : memories) memory->value_ = *value;
  return kept;
}

Result<std::vector<std::shared_ptr<const DevicePart>>> DeviceMeshes::upload(const std::shared_ptr<const void>& owner,
                                                                            std::span<const MeshPart* const> parts) {
  VkDeviceSize bytes = 0;
  for (const MeshPart* part : parts) {
    bytes += part->vertices.size() * sizeof(Vertex) + part->indices.size() * sizeof(uint32_t);
  }
  std::vector<std::shared_ptr<const DevicePart>> brought(parts.size());
  if (bytes == 0) return brought;
  Result<Buffer> staging = staging_.buffer(MemoryKind::upload, bytes);
  if (!staging) return staging.error();
  std::vector<PartSources> sources(parts.size());
  VkDeviceSize at = 0;
  const auto stage = [&](const auto& array) {
    const BufferRange range(*staging, at, array.size() * sizeof(array[0]));
    if (!array.empty()) std::memcpy(staging->data() + at, array.data(), range.size);
    at += range.size;
    return range;
  };
  for (size_t i = 0; i < parts.size(); ++i) sources[i][0] = {stage(parts[i]->vertices), stage(parts[i]->indices)};
  Result<KeptParts> kept = keep(owner, sources);
  if (!kept) return kept.error();
  const Result<bool> there = queue_.wait(kept->value);
  if (!there) {
    retire(std::move(*staging), kept->value);
    return there.error();
  }
  for (size_t i = 0; i < parts.size(); ++i) brought[i] = std::move(kept->chunks[i][0]);
  return brought;
}

uint64_t DeviceMeshes::bytes() {
  const std::scoped_lock lock(mutex_);
  collect();
  return memory_.statistics().used;
}

uint64_t DeviceMeshes::collect() noexcept {
  // Of a lost device nothing is in use any more.
  const Result<uint64_t> now = queue_.reached();
  const uint64_t reached = now ? *now : queue_.lost() ? UINT64_MAX : 0;
  std::erase_if(retired_, [&](const auto& retired) { return retired.first <= reached; });
  return reached;
}

void DeviceMeshes::retire(Buffer&& buffer, uint64_t value) noexcept {
  Buffer retired = std::move(buffer);
  const std::scoped_lock lock(mutex_);
  if (value <= collect()) return;
  try {
    retired_.emplace_back(value, std::move(retired));
  } catch (const std::bad_alloc&) {
    queue_.drain();
  }
}

}  // namespace sgm::vulkan
