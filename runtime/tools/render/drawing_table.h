#pragma once
// Table of the Vulkan functions for drawing, in addition to the table of functions for compute shaders.

#include "backend/vulkan/tables.h"

namespace sgm {

#define SGM_VK_DRAWING(X)         \
  X(vkCreateFence)                \
  X(vkDestroyFence)               \
  X(vkWaitForFences)              \
  X(vkCreateImage)                \
  X(vkDestroyImage)               \
  X(vkGetImageMemoryRequirements) \
  X(vkBindImageMemory)            \
  X(vkCreateImageView)            \
  X(vkDestroyImageView)           \
  X(vkCreateSampler)              \
  X(vkDestroySampler)             \
  X(vkCreateGraphicsPipelines)    \
  X(vkCreateRenderPass)           \
  X(vkDestroyRenderPass)          \
  X(vkCreateFramebuffer)          \
  X(vkDestroyFramebuffer)         \
  X(vkCmdBeginRenderPass)         \
  X(vkCmdEndRenderPass)           \
  X(vkCmdBindVertexBuffers)       \
  X(vkCmdBindIndexBuffer)         \
  X(vkCmdSetViewport)             \
  X(vkCmdSetScissor)              \
  X(vkCmdDraw)                    \
  X(vkCmdDrawIndexed)             \
  X(vkCmdCopyBufferToImage)

struct DrawingTable : vulkan::DeviceTable {
#define SGM_VK_MEMBER(name) PFN_##name name = nullptr;
  SGM_VK_DRAWING(SGM_VK_MEMBER)
#undef SGM_VK_MEMBER
};

}  // namespace sgm
