#include "backend/vulkan/device_meshes.h"

#include <algorithm>
#include <cstring>

namespace sgm::vulkan {
namespace {

/// A draw command, padded so that vertices behind it begin at a multiple of their size.
constexpr VkDeviceSize kDrawBytes = 2 * sizeof(Vertex);
static_assert(sizeof(VkDrawIndexedIndirectCommand) <= kDrawBytes);

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
  KeptParts kept{std::vector<DeviceParts>(chunks.size())};
  std::vector<std::shared_ptr<DeviceMemory>> memories;
  memories.reserve(chunks.size());
  Result<Commands> commands = ring_.begin();
  if (!commands) return commands.error();
  // The memory may be that of parts whose copying is still under way.
  commands->barrier(kTransfer | kCompute, kTransfer);
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
      auto part = std::make_shared<const VulkanPart>(memories.back(), draw,
                                                     static_cast<uint32_t>(source.vertices.size / sizeof(Vertex)),
                                                     static_cast<uint32_t>(source.indices.size / sizeof(uint32_t)));
      copyPart(*commands, source, *part);
      kept.chunks[c][p] = std::move(part);
      draw += bytesOf(source);
    }
  }
  if (memories.empty()) return kept;
  commands->barrier(kTransfer, kTransfer | kCompute);
  const Result<uint64_t> value = ring_.submit(std::move(*commands));
  if (!value) return value.error();
  kept.value = *value;
  for (const auto& memory : memories) memory->value_ = *value;
  return kept;
}

Result<std::shared_ptr<const DevicePart>> DeviceMeshes::upload(const std::shared_ptr<const void>& owner,
                                                               const MeshPart& part) {
  const VkDeviceSize vertices = part.vertices.size() * sizeof(Vertex);
  const VkDeviceSize indices = part.indices.size() * sizeof(uint32_t);
  Result<Buffer> staging = memory_.buffer(MemoryKind::upload, vertices + indices);
  if (!staging) return staging.error();
  std::memcpy(staging->data(), part.vertices.data(), vertices);
  std::memcpy(staging->data() + vertices, part.indices.data(), indices);
  PartSources sources;
  sources[0] = {BufferRange(*staging, 0, vertices), BufferRange(*staging, vertices, indices)};
  Result<KeptParts> kept = keep(owner, {&sources, 1});
  if (!kept) return kept.error();
  retire(std::move(*staging), kept->value);
  if (!kept->chunks[0][0]) return Error{Code::out_of_memory, "no memory of the GPU's is left for a mesh"};
  return std::move(kept->chunks[0][0]);
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
  const auto in_use = [&](const auto& retired) { return retired.first > reached; };
  retired_.erase(std::stable_partition(retired_.begin(), retired_.end(), in_use), retired_.end());
  return reached;
}

void DeviceMeshes::retire(Buffer&& buffer, uint64_t value) noexcept {
  Buffer retired = std::move(buffer);
  const std::scoped_lock lock(mutex_);
  if (value <= collect()) return;
  try {
    retired_.emplace_back(value, std::move(retired));
  } catch (const std::bad_alloc&) {
    static_cast<void>(queue_.wait(value));
  }
}

}  // namespace sgm::vulkan
