#include "backend/vulkan/device_meshes.h"

#include <algorithm>
#include <cstring>

namespace sgm::vulkan {
namespace {

/// Size of a draw command, padded so that the following vertices begin at a multiple of their size.
constexpr VkDeviceSize kDrawBytes = 2 * sizeof(Vertex);
static_assert(sizeof(VkDrawIndexedIndirectCommand) <= kDrawBytes);
// A buffer begins at a multiple of 256 bytes, so vertices are aligned to their size; and the vertex offset of a draw
// command can reach every vertex of a block.
static_assert(256 % sizeof(Vertex) == 0);
static_assert(MemoryOptions{}.largest_block / sizeof(Vertex) <= INT32_MAX);

VkDeviceSize bytesOf(const PartSize& part) {
  if (part.indices == 0) return 0;
  const VkDeviceSize bytes =
      kDrawBytes + part.vertices * VkDeviceSize{sizeof(Vertex)} + part.indices * VkDeviceSize{sizeof(uint32_t)};
  return (bytes + sizeof(Vertex) - 1) / sizeof(Vertex) * sizeof(Vertex);
}

VkDeviceSize bytesOf(const PartSizes& parts) {
  VkDeviceSize bytes = 0;
  for (const PartSize& part : parts) bytes += bytesOf(part);
  return bytes;
}

PartSizes sizesOf(const PartSources& sources) {
  PartSizes sizes;
  for (size_t p = 0; p < sources.size(); ++p) {
    sizes[p].vertices = static_cast<uint32_t>(sources[p].vertices.size / sizeof(Vertex));
    sizes[p].indices = static_cast<uint32_t>(sources[p].indices.size / sizeof(uint32_t));
  }
  return sizes;
}

/// Returns the bytes at an offset of a part's buffer.
BufferRange within(const VulkanPart& part, VkDeviceSize offset, VkDeviceSize bytes) {
  const Buffer& buffer = part.memory().buffer();
  return {buffer, offset - buffer.offset(), bytes};
}

void writeDraw(Commands& commands, const VulkanPart& part) {
  const VkDrawIndexedIndirectCommand draw = part.draw();
  commands.write(within(part, part.drawOffset(), sizeof draw), std::as_bytes(std::span(&draw, 1)));
}

void copyPart(Commands& commands, const PartSource& source, const VulkanPart& part) {
  commands.copy(source.vertices, within(part, part.vertexOffset(), source.vertices.size));
  commands.copy(source.indices, within(part, part.indexOffset(), source.indices.size));
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

PlacedParts DeviceMeshes::place(const std::shared_ptr<const void>& owner, std::span<const PartSizes> chunks) {
  giveBack();
  PlacedParts placed;
  placed.chunks.resize(chunks.size());
  for (size_t c = 0; c < chunks.size(); ++c) {
    const VkDeviceSize bytes = bytesOf(chunks[c]);
    if (bytes == 0) continue;
    Result<Buffer> buffer = memory_.buffer(MemoryKind::device, bytes);
    if (!buffer) continue;
    placed.memories.push_back(std::make_shared<DeviceMemory>(owner, *this, std::move(*buffer)));
    VkDeviceSize draw = placed.memories.back()->buffer().offset();
    for (size_t p = 0; p < chunks[c].size(); ++p) {
      const PartSize& size = chunks[c][p];
      if (size.indices == 0) continue;
      auto part = std::make_shared<const VulkanPart>(placed.memories.back(), draw, size.vertices, size.indices);
      placed.parts.push_back({c, p, part});
      placed.chunks[c][p] = std::move(part);
      draw += bytesOf(size);
    }
  }
  return placed;
}

Result<void> DeviceMeshes::acquire(const PlacedParts& placed) {
  if (placed.parts.empty()) return {};
  std::vector<BufferRange> ranges;
  for (const auto& memory : placed.memories) ranges.emplace_back(memory->buffer());
  Result<Commands> commands = ring_.begin();
  if (!commands) return commands.error();
  commands->acquire(ranges);
  for (const PlacedParts::Part& part : placed.parts) writeDraw(*commands, *part.placed);
  const Result<uint64_t> value = ring_.submit(std::move(*commands));
  if (!value) return value.error();
  for (const auto& memory : placed.memories) memory->value_ = *value;
  return {};
}

void DeviceMeshes::abandon(const PlacedParts& placed) noexcept {
  for (const auto& memory : placed.memories) memory->value_ = DeviceMemory::kNever;
}

Result<KeptParts> DeviceMeshes::keep(const std::shared_ptr<const void>& owner, std::span<const PartSources> chunks) {
  std::vector<PartSizes> sizes(chunks.size());
  std::transform(chunks.begin(), chunks.end(), sizes.begin(), sizesOf);
  PlacedParts placed = place(owner, sizes);
  KeptParts kept{std::move(placed.chunks)};
  if (placed.parts.empty()) return kept;
  // If other threads hold all command buffers of the ring, this call waits; they hold them only briefly.
  Result<Commands> commands = ring_.begin();
  if (!commands) return commands.error();
  // The copies wait for the shaders that write their sources.
  commands->barrier(kCompute, kTransfer);
  for (const PlacedParts::Part& part : placed.parts) {
    writeDraw(*commands, *part.placed);
    copyPart(*commands, chunks[part.chunk][part.part], *part.placed);
  }
  commands->barrier(kTransfer, kCompute);
  const Result<uint64_t> value = ring_.submit(std::move(*commands));
  if (!value) return value.error();
  kept.value = *value;
  for (const auto& memory : placed.memories) memory->value_ = *value;
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
  giveBack();
  return memory_.statistics().used;
}

void DeviceMeshes::giveBack() noexcept {
  Retired ended;
  const std::scoped_lock lock(mutex_);
  ended = takeEnded();
}

uint64_t DeviceMeshes::reached() const noexcept {
  // A lost device does not use any memory any more, so all buffers can be freed.
  const Result<uint64_t> now = queue_.reached();
  return now ? *now : queue_.lost() ? UINT64_MAX : 0;
}

DeviceMeshes::Retired DeviceMeshes::takeEnded() noexcept {
  const uint64_t now = reached();
  Retired ended;
  for (auto at = retired_.begin(); at != retired_.end();) {
    const auto next = std::next(at);
    if (at->first <= now) ended.splice(ended.end(), retired_, at);
    at = next;
  }
  return ended;
}

void DeviceMeshes::retire(Buffer&& buffer, uint64_t value) noexcept {
  Buffer retired = std::move(buffer);
  // kNever: another API may still be writing to the buffer, regardless of the state of this queue. So the buffer is
  // never freed.
  if (value == DeviceMemory::kNever) return retired.forget();
  giveBack();
  if (value <= reached()) return;
  try {
    Retired one;
    one.emplace_back(value, std::move(retired));
    const std::scoped_lock lock(mutex_);
    retired_.splice(retired_.end(), one);
  } catch (const std::bad_alloc&) {
    queue_.drain();
  }
}

}  // namespace sgm::vulkan
