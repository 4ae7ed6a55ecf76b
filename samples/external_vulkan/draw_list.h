#pragma once
// What one frame draws: parts of chunks, each a command in a buffer, sorted so that few buffers are bound.

#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

/// Of a chunk, in the vertex shader.
struct ChunkRecord {
  std::array<int32_t, 3> offset{};  ///< from the camera's place to the chunk's origin, units
  int32_t cell_units = 0;
};

using ChunkName = std::array<int32_t, 4>;  ///< level, x, y, z

/// The body of a chunk (part 0) or a seam (1 + face). firstInstance is its record's index.
struct Draw {
  VkBuffer buffer = VK_NULL_HANDLE;  ///< bound from its beginning, as vertices and as indices
  VkDrawIndexedIndirectCommand command{};
  ChunkName chunk{};
  uint32_t part = 0;
};

struct DrawList {
  std::vector<Draw> draws;
  std::vector<ChunkRecord> records;
  // What must have come to pass on the device before it is drawn; no semaphore: nothing.
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
