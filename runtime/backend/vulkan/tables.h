#pragma once
// The Vulkan functions that the library calls, in tables that belong to their instance and device.
//
// volk keeps the loader, the instance and (through volkLoadDeviceTable) the device functions in process globals, which
// a host program may use for its own instance. These tables need no globals: each pointer belongs to the object for
// which it was loaded. So they never mix with an engine's, and two instances of the library can coexist on two threads.
// Tables are values: a test may replace a pointer in one.

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

/// The debug functions are null if the instance was created without VK_EXT_debug_utils.
struct InstanceTable {
  SGM_VK_INSTANCE(SGM_VK_MEMBER)
  SGM_VK_INSTANCE_DEBUG(SGM_VK_MEMBER)
};

/// The functions for computing. Drawing code has a table of its own whose first member is this one. Functions of
/// extensions are null if the device was created without the extension.
struct DeviceTable {
  SGM_VK_DEVICE(SGM_VK_MEMBER)
  SGM_VK_DEVICE_EXTENSIONS(SGM_VK_MEMBER)
};

#undef SGM_VK_MEMBER

}  // namespace sgm::vulkan
