#pragma once
// The Vulkan devices of this machine, and which of them can mesh.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "backend/vulkan/instance.h"
#include "base/shared_memory.h"

namespace sgm::vulkan {

/// What a device says of itself. Where it has no Vulkan 1.2, only what stands before `exact` is known.
struct DeviceInfo {
  std::string name;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  uint32_t vendor = 0;          ///< PCI number, or Khronos'
  uint32_t device = 0;          ///< the vendor's number
  uint32_t driver_version = 0;  ///< in the vendor's own packing
  uint32_t api_version = 0;     ///< VK_MAKE_API_VERSION
  std::array<uint8_t, VK_UUID_SIZE> cache_id{};
  bool computes = false;  ///< a queue family has VK_QUEUE_COMPUTE_BIT
  uint64_t max_storage_range = 0;
  uint32_t max_shared_bytes = 0;
  uint32_t max_invocations = 0;  ///< of a workgroup
  uint32_t max_push_bytes = 0;
  uint32_t max_storage_buffers = 0;  ///< of a stage

  /// shaderRoundingModeRTEFloat32: shaders may demand round-to-nearest, so the arithmetic contract holds on it.
  bool exact = false;
  bool preserves_denormals = false;  ///< shaderDenormPreserveFloat32
  bool timeline_semaphores = false;
  bool subgroups_compute = false;  ///< subgroup operations work in compute shaders
  VkSubgroupFeatureFlags subgroup_operations = 0;
  uint32_t subgroup_size = 0;
  uint64_t max_allocation = 0;  ///< bytes of one vkAllocateMemory
  std::string driver;
  DeviceId id{};  ///< deviceUUID

  bool software() const { return type == VK_PHYSICAL_DEVICE_TYPE_CPU; }  ///< lavapipe and its like
};

/// Why the device cannot mesh: the first feature or limit that it lacks, in one sentence. Empty: it can. Pure.
std::string lackOf(const DeviceInfo& info);

/// How fast a kind of device is likely to be: discrete 4, integrated 3, virtual 2, software 1, others 0.
int rankOf(VkPhysicalDeviceType type);

DeviceInfo describe(const InstanceTable& calls, VkPhysicalDevice device);

/// Every device of this machine, unusable ones too; none is no error. Errors: as Instance::create.
Result<std::vector<DeviceInfo>> listDevices();

}  // namespace sgm::vulkan
