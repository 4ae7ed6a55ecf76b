#pragma once
// The Vulkan functions we call, in tables that belong to their instance and device.
//
// volk keeps the loader, the instance and (through volkLoadDeviceTable) the device resolver in process globals, which a
// program that embeds us may use for its own instance. These tables need none: every pointer is reached through the
// object that it was loaded for, and two instances of ours can live side by side on two threads.

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

namespace sgm {

#define SGM_VK_GLOBAL(X)        \
  X(vkCreateInstance)           \
  X(vkEnumerateInstanceVersion) \
  X(vkEnumerateInstanceLayerProperties)

#define SGM_VK_INSTANCE(X)                    \
  X(vkDestroyInstance)                        \
  X(vkEnumeratePhysicalDevices)               \
  X(vkGetPhysicalDeviceProperties)            \
  X(vkGetPhysicalDeviceProperties2)           \
  X(vkGetPhysicalDeviceMemoryProperties)      \
  X(vkGetPhysicalDeviceQueueFamilyProperties) \
  X(vkGetPhysicalDeviceFormatProperties)      \
  X(vkCreateDevice)                           \
  X(vkGetDeviceProcAddr)

#define SGM_VK_INSTANCE_DEBUG(X)    \
  X(vkCreateDebugUtilsMessengerEXT) \
  X(vkDestroyDebugUtilsMessengerEXT)

#define SGM_VK_DEVICE(X)           \
  X(vkDestroyDevice)               \
  X(vkGetDeviceQueue)              \
  X(vkDeviceWaitIdle)              \
  X(vkQueueSubmit)                 \
  X(vkCreateFence)                 \
  X(vkDestroyFence)                \
  X(vkWaitForFences)               \
  X(vkCreateCommandPool)           \
  X(vkDestroyCommandPool)          \
  X(vkAllocateCommandBuffers)      \
  X(vkBeginCommandBuffer)          \
  X(vkEndCommandBuffer)            \
  X(vkCreateBuffer)                \
  X(vkDestroyBuffer)               \
  X(vkGetBufferMemoryRequirements) \
  X(vkBindBufferMemory)            \
  X(vkCreateImage)                 \
  X(vkDestroyImage)                \
  X(vkGetImageMemoryRequirements)  \
  X(vkBindImageMemory)             \
  X(vkCreateImageView)             \
  X(vkDestroyImageView)            \
  X(vkCreateSampler)               \
  X(vkDestroySampler)              \
  X(vkAllocateMemory)              \
  X(vkFreeMemory)                  \
  X(vkMapMemory)                   \
  X(vkCreateShaderModule)          \
  X(vkDestroyShaderModule)         \
  X(vkCreateDescriptorSetLayout)   \
  X(vkDestroyDescriptorSetLayout)  \
  X(vkCreateDescriptorPool)        \
  X(vkDestroyDescriptorPool)       \
  X(vkAllocateDescriptorSets)      \
  X(vkUpdateDescriptorSets)        \
  X(vkCreatePipelineLayout)        \
  X(vkDestroyPipelineLayout)       \
  X(vkCreateGraphicsPipelines)     \
  X(vkCreateComputePipelines)      \
  X(vkDestroyPipeline)             \
  X(vkCreateRenderPass)            \
  X(vkDestroyRenderPass)           \
  X(vkCreateFramebuffer)           \
  X(vkDestroyFramebuffer)          \
  X(vkCmdBeginRenderPass)          \
  X(vkCmdEndRenderPass)            \
  X(vkCmdBindPipeline)             \
  X(vkCmdBindDescriptorSets)       \
  X(vkCmdBindVertexBuffers)        \
  X(vkCmdBindIndexBuffer)          \
  X(vkCmdPushConstants)            \
  X(vkCmdSetViewport)              \
  X(vkCmdSetScissor)               \
  X(vkCmdDrawIndexed)              \
  X(vkCmdDispatch)                 \
  X(vkCmdPipelineBarrier)

#define SGM_VK_MEMBER(name) PFN_##name name = nullptr;

struct VulkanGlobalTable {
  PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr;
  SGM_VK_GLOBAL(SGM_VK_MEMBER)
};

/// The debug functions are null where the instance was made without VK_EXT_debug_utils.
struct VulkanInstanceTable {
  SGM_VK_INSTANCE(SGM_VK_MEMBER)
  SGM_VK_INSTANCE_DEBUG(SGM_VK_MEMBER)
};

struct VulkanDeviceTable {
  SGM_VK_DEVICE(SGM_VK_MEMBER)
};

#undef SGM_VK_MEMBER

}  // namespace sgm
