#pragma once
// Checks mesh parts in the memory of an engine's device, as the engine would read them.

#include <cstring>
#include <utility>
#include <vector>

#include "backend/vulkan/device_meshes.h"
#include "catch.h"
#include "unit/vulkan/engine.h"

namespace sgm {

/// A mesh part in device memory, and the part on the host that it must equal.
using PartOnDevice = std::pair<const DevicePart*, const MeshPart*>;

/// Waits until the device is idle, copies the parts to the host, and compares them byte by byte.
inline void checkOnDevice(vulkan::Engine& engine, const std::vector<PartOnDevice>& parts) {
  if (parts.empty()) return;
  REQUIRE(engine.calls.vkDeviceWaitIdle(engine.device) == VK_SUCCESS);
  const auto device = vulkan::Device::borrow(engine.lend());
  REQUIRE(device);
  const auto queue = vulkan::Queue::create(**device);
  REQUIRE(queue);
  vulkan::Memory memory(**device);
  const auto ring = vulkan::CommandRing::create(**queue);
  REQUIRE(ring);
  VkDeviceSize bytes = 0;
  for (const auto& [found, expected] : parts) {
    bytes += expected->vertices.size() * sizeof(Vertex) + expected->indices.size() * sizeof(uint32_t);
  }
  const auto back = memory.buffer(vulkan::MemoryKind::readback, bytes);
  REQUIRE(back);
  auto commands = (*ring)->begin();
  REQUIRE(commands);
  VkDeviceSize at = 0;
  const auto copy = [&](const vulkan::Buffer& buffer, VkDeviceSize offset, VkDeviceSize size) {
    commands->copy(vulkan::BufferRange(buffer, offset - buffer.offset(), size), vulkan::BufferRange(*back, at, size));
    at += size;
  };
  for (const auto& [found, expected] : parts) {
    const auto& part = static_cast<const vulkan::VulkanPart&>(*found);
    REQUIRE(part.vertexCount() == expected->vertices.size());
    REQUIRE(part.indexCount() == expected->indices.size());
    copy(part.memory().buffer(), part.vertexOffset(), expected->vertices.size() * sizeof(Vertex));
    copy(part.memory().buffer(), part.indexOffset(), expected->indices.size() * sizeof(uint32_t));
  }
  commands->barrier(vulkan::kTransfer, vulkan::kHost);
  const auto value = (*ring)->submit(std::move(*commands));
  REQUIRE(value);
  REQUIRE((*queue)->wait(*value));
  REQUIRE(back->beforeRead());
  const std::byte* bytes_back = back->data();
  const auto same = [&](const auto& array) {
    const size_t size = array.size() * sizeof(array[0]);
    return std::memcmp(std::exchange(bytes_back, bytes_back + size), array.data(), size) == 0;
  };
  for (size_t i = 0; i < parts.size(); ++i) {
    CAPTURE(i);
    CHECK(same(parts[i].second->vertices));
    CHECK(same(parts[i].second->indices));
  }
}

}  // namespace sgm
