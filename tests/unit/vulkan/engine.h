#pragma once
// An engine that provides its Vulkan device to the library.

#include "backend/vulkan/device.h"
#include "catch.h"

namespace sgm::vulkan {

/// An engine's device that is made without the library. Until the end, the validation layer must report nothing.
struct Engine {
  std::unique_ptr<Instance> instance;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  DeviceTable calls;
  int locks = 0, unlocks = 0, held = 0;

  /// external_memory: enables the extension VK_KHR_external_memory_fd.
  explicit Engine(Validation validation = Validation::synchronization, bool external_memory = false) {
    auto made = Instance::create({validation});
    REQUIRE(made);
    instance = std::move(*made);
    const auto devices = instance->devices();
    REQUIRE(devices);
    for (VkPhysicalDevice candidate : *devices) {
      if (unsupportedReason(describe(instance->calls(), candidate)).empty()) physical = candidate;
    }
    REQUIRE(physical);
    const float priority = 1;
    VkDeviceQueueCreateInfo queue_info{};
    queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
    VkPhysicalDeviceTimelineSemaphoreFeatures timeline{};
    timeline.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES;
    timeline.timelineSemaphore = VK_TRUE;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &timeline;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue_info;
    const char* const extension = VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME;
    info.enabledExtensionCount = external_memory ? 1 : 0;
    info.ppEnabledExtensionNames = &extension;
    REQUIRE(instance->calls().vkCreateDevice(physical, &info, nullptr, &device) == VK_SUCCESS);
    REQUIRE(loadDevice(instance->calls(), device, calls));
    calls.vkGetDeviceQueue(device, 0, 0, &queue);
  }
  ~Engine() {
    calls.vkDestroyDevice(device, nullptr);
    CHECK(instance->messages() == std::vector<std::string>());
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  BorrowedDevice lend() {
    BorrowedDevice external;
    external.get_instance_proc_addr = instance->resolver();
    external.instance = instance->handle();
    external.physical = physical;
    external.device = device;
    external.queue = queue;
    external.lock = [](void* user) { ++static_cast<Engine*>(user)->locks, ++static_cast<Engine*>(user)->held; };
    external.unlock = [](void* user) { ++static_cast<Engine*>(user)->unlocks, --static_cast<Engine*>(user)->held; };
    external.user = this;
    external.api_version = VK_API_VERSION_1_2;
    external.timeline_semaphores = true;
    return external;
  }
};

}  // namespace sgm::vulkan
