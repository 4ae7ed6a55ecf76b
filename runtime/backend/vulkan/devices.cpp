#include "backend/vulkan/devices.h"

#include <algorithm>

namespace sgm::vulkan {
namespace {

// Limits that a device must meet so that the mesher's shaders run.
constexpr uint64_t kLeastStorageRange = uint64_t{128} << 20;
constexpr uint32_t kLeastSharedBytes = 32 << 10;
constexpr uint32_t kLeastInvocations = 256;
constexpr uint32_t kLeastPushBytes = 128;
constexpr uint32_t kLeastStorageBuffers = 8;
constexpr uint32_t kLeastSubgroup = 8, kLargestSubgroup = 64;

std::string versionText(uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::vector<VkQueueFamilyProperties> familiesOf(const InstanceTable& calls, VkPhysicalDevice device) {
  uint32_t count = 0;
  calls.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  calls.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  return families;
}

}  // namespace

int rankOf(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 1;
    default:
      return 0;
  }
}

std::string unsupportedReason(const DeviceInfo& info) {
  const auto lacks = [&](const std::string& what) { return info.name + " lacks " + what; };
  const auto below = [&](const char* limit, uint64_t has, uint64_t needed) {
    return info.name + " has a " + limit + " of " + std::to_string(has) + ", but at least " + std::to_string(needed) +
           " are needed";
  };
  if (info.api_version < VK_API_VERSION_1_2) {
    return info.name + " supports Vulkan " + versionText(info.api_version) + ", but 1.2 is needed: update its driver";
  }
  if (!info.computes) return lacks("a compute queue");
  if (!info.timeline_semaphores) return lacks("the feature timelineSemaphore");
  if (!info.subgroups_compute) return lacks("subgroup operations in compute shaders");
  const struct {
    VkSubgroupFeatureFlags bit;
    const char* name;
  } operations[] = {{VK_SUBGROUP_FEATURE_BASIC_BIT, "basic"},
                    {VK_SUBGROUP_FEATURE_VOTE_BIT, "vote"},
                    {VK_SUBGROUP_FEATURE_BALLOT_BIT, "ballot"},
                    {VK_SUBGROUP_FEATURE_ARITHMETIC_BIT, "arithmetic"},
                    {VK_SUBGROUP_FEATURE_SHUFFLE_BIT, "shuffle"}};
  for (const auto& operation : operations) {
    if (!(info.subgroup_operations & operation.bit))
      return lacks(std::string("the subgroup operations ") + operation.name);
  }
  if (info.subgroup_size < kLeastSubgroup || info.subgroup_size > kLargestSubgroup) {
    return info.name + " has a subgroupSize of " + std::to_string(info.subgroup_size) + ", but 8 to 64 are needed";
  }
  if (info.max_storage_range < kLeastStorageRange) {
    return below("maxStorageBufferRange", info.max_storage_range, kLeastStorageRange);
  }
  if (info.max_shared_bytes < kLeastSharedBytes) {
    return below("maxComputeSharedMemorySize", info.max_shared_bytes, kLeastSharedBytes);
  }
  if (info.max_invocations < kLeastInvocations) {
    return below("maxComputeWorkGroupInvocations", info.max_invocations, kLeastInvocations);
  }
  if (info.max_push_bytes < kLeastPushBytes) {
    return below("maxPushConstantsSize", info.max_push_bytes, kLeastPushBytes);
  }
  if (info.max_storage_buffers < kLeastStorageBuffers) {
    return below("maxPerStageDescriptorStorageBuffers", info.max_storage_buffers, kLeastStorageBuffers);
  }
  return {};
}

DeviceInfo describe(const InstanceTable& calls, VkPhysicalDevice device) {
  VkPhysicalDeviceProperties basic;
  calls.vkGetPhysicalDeviceProperties(device, &basic);
  DeviceInfo info;
  info.name = basic.deviceName;
  info.type = basic.deviceType;
  info.vendor = basic.vendorID;
  info.device = basic.deviceID;
  info.driver_version = basic.driverVersion;
  info.api_version = basic.apiVersion;
  std::copy(std::begin(basic.pipelineCacheUUID), std::end(basic.pipelineCacheUUID), info.cache_id.begin());
  for (const VkQueueFamilyProperties& family : familiesOf(calls, device)) {
    info.computes = info.computes || (family.queueFlags & VK_QUEUE_COMPUTE_BIT);
  }
  info.max_storage_range = basic.limits.maxStorageBufferRange;
  info.max_shared_bytes = basic.limits.maxComputeSharedMemorySize;
  info.max_invocations = basic.limits.maxComputeWorkGroupInvocations;
  info.max_push_bytes = basic.limits.maxPushConstantsSize;
  info.max_storage_buffers = basic.limits.maxPerStageDescriptorStorageBuffers;
  if (info.api_version < VK_API_VERSION_1_2) return info;

  VkPhysicalDeviceVulkan11Properties properties11{};
  properties11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
  VkPhysicalDeviceVulkan12Properties properties12{};
  properties12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
  properties12.pNext = &properties11;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &properties12;
  calls.vkGetPhysicalDeviceProperties2(device, &properties);
  VkPhysicalDeviceTimelineSemaphoreFeatures timeline{};
  timeline.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &timeline;
  calls.vkGetPhysicalDeviceFeatures2(device, &features);
  std::copy(std::begin(properties11.deviceUUID), std::end(properties11.deviceUUID), info.id.begin());
  info.exact = properties12.shaderRoundingModeRTEFloat32 == VK_TRUE;
  info.preserves_denormals = properties12.shaderDenormPreserveFloat32 == VK_TRUE;
  info.driver = std::string(properties12.driverName) + " " + properties12.driverInfo;
  info.timeline_semaphores = timeline.timelineSemaphore == VK_TRUE;
  info.subgroups_compute = (properties11.subgroupSupportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  info.subgroup_operations = properties11.subgroupSupportedOperations;
  info.subgroup_size = properties11.subgroupSize;
  info.max_allocation = properties11.maxMemoryAllocationSize;
  return info;
}

Result<std::vector<DeviceInfo>> listDevices() {
  const auto instance = Instance::create();
  if (!instance) return instance.error();
  const auto devices = (*instance)->devices();
  if (!devices) return devices.error();
  std::vector<DeviceInfo> infos;
  for (VkPhysicalDevice device : *devices) infos.push_back(describe((*instance)->calls(), device));
  return infos;
}

}  // namespace sgm::vulkan
