#pragma once
// The draws of one frame. Each draw is the command that draws one part of a chunk from a buffer. The draws are sorted
// by buffer, so that each buffer is bound only once.

#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

/// Data of a chunk for the vertex shader.
struct ChunkRecord {
  std::array<int32_t, 3> offset{};  ///< vector from the camera to the chunk's origin, in units
  int32_t cell_units = 0;
};

using ChunkName = std::array<int32_t, 4>;  ///< level, x, y, z

/// The draw of a chunk's body (part 0) or of a seam (1 + face). The command's firstInstance is the index of the chunk's
/// ChunkRecord.
struct Draw {
  VkBuffer buffer = VK_NULL_HANDLE;  ///< bound from its beginning, as vertex buffer and as index buffer
  VkDrawIndexedIndirectCommand command{};
  ChunkName chunk{};
  uint32_t part = 0;
};

struct DrawList {
  std::vector<Draw> draws;
  std::vector<ChunkRecord> records;
  // The device must not draw the list before this timeline semaphore reaches `value`. Null: no wait is needed.
  VkSemaphore semaphore = VK_NULL_HANDLE;
  uint64_t value = 0;

  uint64_t triangles() const {
    uint64_t indices = 0;
    for (const Draw& draw : draws) indices += draw.command.indexCount;
    return indices / 3;
  }
  void sortByBuffer() {
    std::stable_sort(draws.begin(), draws.end(),
                     [](const Draw& a, const Draw& b) { return std::less<VkBuffer>()(a.buffer, b.buffer); });
  }
};
