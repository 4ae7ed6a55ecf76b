#pragma once
// Lists the Vulkan devices of this machine, and decides which of them can mesh.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "backend/vulkan/instance.h"
#include "base/shared_memory.h"

namespace sgm::vulkan {

/// Properties of a device. Without Vulkan 1.2 only the members before `exact` are known.
struct DeviceInfo {
  std::string name;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  uint32_t vendor = 0;          ///< PCI number, or Khronos'
  uint32_t device = 0;          ///< the vendor's number
  uint32_t driver_version = 0;  ///< in the vendor's encoding
  uint32_t api_version = 0;     ///< VK_MAKE_API_VERSION
  std::array<uint8_t, VK_UUID_SIZE> cache_id{};
  bool computes = false;  ///< a queue family has VK_QUEUE_COMPUTE_BIT
  uint64_t max_storage_range = 0;
  uint32_t max_shared_bytes = 0;
  uint32_t max_invocations = 0;  ///< of a workgroup
  uint32_t max_push_bytes = 0;
  uint32_t max_storage_buffers = 0;  ///< of a stage

  /// shaderRoundingModeRTEFloat32: shaders may require round-to-nearest, so the arithmetic contract holds.
  bool exact = false;
  bool preserves_denormals = false;  ///< shaderDenormPreserveFloat32
  bool timeline_semaphores = false;
  bool subgroups_compute = false;  ///< subgroup operations work in compute shaders
  VkSubgroupFeatureFlags subgroup_operations = 0;
  uint32_t subgroup_size = 0;
  uint64_t max_allocation = 0;  ///< bytes of one vkAllocateMemory
  std::string driver;
  DeviceId id{};  ///< deviceUUID

  bool software() const { return type == VK_PHYSICAL_DEVICE_TYPE_CPU; }  ///< lavapipe and similar
};

/// The reason why the device cannot mesh: the first missing feature or limit, as a sentence. Empty if it can. Pure.
std::string lackOf(const DeviceInfo& info);

/// A rank by the likely speed of the device's type: discrete 4, integrated 3, virtual 2, software 1, others 0.
int rankOf(VkPhysicalDeviceType type);

DeviceInfo describe(const InstanceTable& calls, VkPhysicalDevice device);

/// All devices of this machine, including unusable ones; an empty list is not an error. Errors: as Instance::create.
Result<std::vector<DeviceInfo>> listDevices();

}  // namespace sgm::vulkan
