#pragma once
// The Vulkan functions we call, in tables that belong to their instance and device.
//
// volk keeps the loader, the instance and (through volkLoadDeviceTable) the device resolver in process globals, which a
// program that embeds us may use for its own instance. These tables need none: every pointer is reached through the
// object that it was loaded for, so that ours never meet an engine's, and two instances of ours can live side by side
// on two threads. Tables are values: a test may replace a pointer in one.

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

namespace sgm::vulkan {

#define SGM_VK_GLOBAL(X) \
  X(vkCreateInstance)    \
  X(vkEnumerateInstanceVersion)

#define SGM_VK_INSTANCE(X)                       \
  X(vkDestroyInstance)                           \
  X(vkEnumeratePhysicalDevices)                  \
  X(vkEnumerateDeviceExtensionProperties)        \
  X(vkGetPhysicalDeviceProperties)               \
  X(vkGetPhysicalDeviceProperties2)              \
  X(vkGetPhysicalDeviceFeatures2)                \
  X(vkGetPhysicalDeviceMemoryProperties)         \
  X(vkGetPhysicalDeviceMemoryProperties2)        \
  X(vkGetPhysicalDeviceQueueFamilyProperties)    \
  X(vkGetPhysicalDeviceExternalBufferProperties) \
  X(vkCreateDevice)                              \
  X(vkGetDeviceProcAddr)

#define SGM_VK_INSTANCE_DEBUG(X)    \
  X(vkCreateDebugUtilsMessengerEXT) \
  X(vkDestroyDebugUtilsMessengerEXT)

#define SGM_VK_DEVICE(X)            \
  X(vkDestroyDevice)                \
  X(vkGetDeviceQueue)               \
  X(vkDeviceWaitIdle)               \
  X(vkQueueSubmit)                  \
  X(vkCreateSemaphore)              \
  X(vkDestroySemaphore)             \
  X(vkWaitSemaphores)               \
  X(vkGetSemaphoreCounterValue)     \
  X(vkCreateCommandPool)            \
  X(vkDestroyCommandPool)           \
  X(vkResetCommandPool)             \
  X(vkAllocateCommandBuffers)       \
  X(vkBeginCommandBuffer)           \
  X(vkEndCommandBuffer)             \
  X(vkCreateBuffer)                 \
  X(vkDestroyBuffer)                \
  X(vkGetBufferMemoryRequirements)  \
  X(vkBindBufferMemory)             \
  X(vkAllocateMemory)               \
  X(vkFreeMemory)                   \
  X(vkMapMemory)                    \
  X(vkInvalidateMappedMemoryRanges) \
  X(vkCreateShaderModule)           \
  X(vkDestroyShaderModule)          \
  X(vkCreateDescriptorSetLayout)    \
  X(vkDestroyDescriptorSetLayout)   \
  X(vkCreateDescriptorPool)         \
  X(vkDestroyDescriptorPool)        \
  X(vkResetDescriptorPool)          \
  X(vkAllocateDescriptorSets)       \
  X(vkUpdateDescriptorSets)         \
  X(vkCreatePipelineLayout)         \
  X(vkDestroyPipelineLayout)        \
  X(vkCreatePipelineCache)          \
  X(vkDestroyPipelineCache)         \
  X(vkGetPipelineCacheData)         \
  X(vkCreateComputePipelines)       \
  X(vkDestroyPipeline)              \
  X(vkCmdBindPipeline)              \
  X(vkCmdBindDescriptorSets)        \
  X(vkCmdPushConstants)             \
  X(vkCmdDispatch)                  \
  X(vkCmdDispatchIndirect)          \
  X(vkCmdFillBuffer)                \
  X(vkCmdCopyBuffer)                \
  X(vkCmdUpdateBuffer)              \
  X(vkCmdPipelineBarrier)

#define SGM_VK_DEVICE_EXTENSIONS(X) X(vkGetMemoryFdKHR)

#define SGM_VK_MEMBER(name) PFN_##name name = nullptr;

struct GlobalTable {
  PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr;
  SGM_VK_GLOBAL(SGM_VK_MEMBER)
};

/// The debug functions are null where the instance was made without VK_EXT_debug_utils.
struct InstanceTable {
  SGM_VK_INSTANCE(SGM_VK_MEMBER)
  SGM_VK_INSTANCE_DEBUG(SGM_VK_MEMBER)
};

/// What computing needs. Who draws, too, has a table of its own that begins with this one. The functions of extensions
/// are null where the device was made without them.
struct DeviceTable {
  SGM_VK_DEVICE(SGM_VK_MEMBER)
  SGM_VK_DEVICE_EXTENSIONS(SGM_VK_MEMBER)
};

#undef SGM_VK_MEMBER

}  // namespace sgm::vulkan
