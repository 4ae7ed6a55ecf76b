#pragma once
// The engine's own Vulkan device. It has one queue for drawing and computing, which the engine and the library share.

#include <sgm/sgm_vulkan.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "vulkan_call.h"
#include "vulkan_instance.h"

class VulkanDevice {
 public:
  /// validation: see VulkanInstance. share_memory: whether CUDA shall write meshes into memory that this device shares.
  /// Throws NoDevice.
  VulkanDevice(Validation* validation, bool share_memory) : instance_(validation), share_memory_(share_memory) {
    openBest();
  }
  VulkanDevice(const VulkanDevice&) = delete;
  VulkanDevice& operator=(const VulkanDevice&) = delete;
  ~VulkanDevice() { vkDestroyDevice(device_, nullptr); }

  VkDevice handle() const { return device_; }
  uint32_t family() const { return family_; }

  /// Thread-safe: a lock ensures that only one thread at a time uses the queue, which the library uses too.
  void submit(const VkSubmitInfo& info) {
    const std::lock_guard lock(queue_mutex_);
    must(vkQueueSubmit(queue_, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
  }

  /// Describes the device to the library. The device must outlive the runtime.
  sgm_vulkan_device_desc lend() {
    sgm_vulkan_device_desc desc = SGM_VULKAN_DEVICE_DESC_INIT;
    desc.api_version = VulkanInstance::kApiVersion;
    desc.queue_family = family_;
    desc.get_instance_proc_addr = vkGetInstanceProcAddr;
    desc.instance = instance_.handle();
    desc.physical_device = physical_;
    desc.device = device_;
    desc.queue = queue_;
    desc.timeline_semaphores = 1;
    desc.memory_budget = memory_budget_ ? 1 : 0;
    desc.external_memory = share_memory_ ? 1 : 0;
    desc.lock_queue = [](void* user) { static_cast<VulkanDevice*>(user)->queue_mutex_.lock(); };
    desc.unlock_queue = [](void* user) { static_cast<VulkanDevice*>(user)->queue_mutex_.unlock(); };
    desc.user = this;
    return desc;
  }

  /// Index of a memory type with the wanted properties among the types that a resource allows.
  uint32_t memoryType(uint32_t types, VkMemoryPropertyFlags wanted) const {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      if ((types >> i & 1u) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    }
    throw std::runtime_error("the device has no memory of the wanted kind");
  }

 private:
  static bool hasExtension(VkPhysicalDevice device, const char* name) {
    uint32_t count = 0;
    must(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
         "vkEnumerateDeviceExtensionProperties");
    std::vector<VkExtensionProperties> all(count);
    must(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, all.data()),
         "vkEnumerateDeviceExtensionProperties");
    return std::any_of(all.begin(), all.end(),
                       [&](const VkExtensionProperties& one) { return std::strcmp(one.extensionName, name) == 0; });
  }

  static std::optional<uint32_t> drawingFamily(VkPhysicalDevice device) {
    constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (uint32_t i = 0; i < count; ++i) {
      if ((families[i].queueFlags & kWanted) == kWanted) return i;
    }
    return {};
  }

  /// Returns the first required feature that a device lacks; an empty text if the device has all of them.
  std::string unsupportedReason(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties) const {
    if (properties.apiVersion < VulkanInstance::kApiVersion) return "Vulkan 1.2";
    VkPhysicalDeviceVulkan12Features features12{};
    features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &features12;
    vkGetPhysicalDeviceFeatures2(device, &features);
    if (!features12.timelineSemaphore) return "timelineSemaphore";
    if (!features.features.multiDrawIndirect) return "multiDrawIndirect";
    if (!features.features.drawIndirectFirstInstance) return "drawIndirectFirstInstance";
    if (!drawingFamily(device)) return "a queue that both draws and computes";
    if (share_memory_ && !hasExtension(device, kShareMemory)) return kShareMemory;
    return {};
  }

  static int rankOf(VkPhysicalDeviceType type) {
    switch (type) {
      case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
      case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
      case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
      default:
        return 1;
    }
  }

  void openBest() {
    int best = 0;
    std::string lacks;
    for (VkPhysicalDevice candidate : instance_.devices()) {
      VkPhysicalDeviceProperties properties;
      vkGetPhysicalDeviceProperties(candidate, &properties);
      const std::string lack = unsupportedReason(candidate, properties);
      if (!lack.empty()) lacks += std::string("; ") + properties.deviceName + " lacks " + lack;
      if (!lack.empty() || rankOf(properties.deviceType) <= best) continue;
      best = rankOf(properties.deviceType);
      physical_ = candidate;
    }
    if (!physical_) throw NoDevice("there is no usable Vulkan device" + lacks);
    family_ = *drawingFamily(physical_);
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceVulkan12Features features12{};
    features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    features12.timelineSemaphore = VK_TRUE;
    VkPhysicalDeviceFeatures features{};
    features.multiDrawIndirect = VK_TRUE;
    features.drawIndirectFirstInstance = VK_TRUE;
    std::vector<const char*> extensions;
    memory_budget_ = hasExtension(physical_, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    if (memory_budget_) extensions.push_back(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    if (share_memory_) extensions.push_back(kShareMemory);
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &features12;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    info.pEnabledFeatures = &features;
    must(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, family_, 0, &queue_);
  }

  static constexpr const char* kShareMemory = VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME;

  VulkanInstance instance_;
  const bool share_memory_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  bool memory_budget_ = false;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::mutex queue_mutex_;
};
