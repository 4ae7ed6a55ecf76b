#pragma once
// Lists the Vulkan devices of this machine, and decides which of them can mesh.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "backend/vulkan/instance.h"
#include "base/shared_memory.h"

namespace sgm::vulkan {

/// Properties of a device. If the device lacks Vulkan 1.2, only the members before `exact` are known.
struct DeviceInfo {
  std::string name;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  uint32_t vendor = 0;          ///< PCI id, or an id assigned by Khronos
  uint32_t device = 0;          ///< device id assigned by the vendor
  uint32_t driver_version = 0;  ///< in the vendor's encoding
  uint32_t api_version = 0;     ///< VK_MAKE_API_VERSION
  std::array<uint8_t, VK_UUID_SIZE> cache_id{};
  bool computes = false;  ///< true if a queue family has VK_QUEUE_COMPUTE_BIT
  uint64_t max_storage_range = 0;
  uint32_t max_shared_bytes = 0;
  uint32_t max_invocations = 0;  ///< maximum number of invocations in a workgroup
  uint32_t max_push_bytes = 0;
  uint32_t max_storage_buffers = 0;  ///< maximum number of storage buffers per shader stage

  /// True if shaders may require round-to-nearest (shaderRoundingModeRTEFloat32), so that the arithmetic contract
  /// holds.
  bool exact = false;
  bool preserves_denormals = false;  ///< shaderDenormPreserveFloat32
  bool timeline_semaphores = false;
  bool subgroups_compute = false;  ///< true if subgroup operations work in compute shaders
  VkSubgroupFeatureFlags subgroup_operations = 0;
  uint32_t subgroup_size = 0;
  uint64_t max_allocation = 0;  ///< maximum size of one vkAllocateMemory, in bytes
  std::string driver;
  DeviceId id{};  ///< deviceUUID

  bool software() const { return type == VK_PHYSICAL_DEVICE_TYPE_CPU; }  ///< true for lavapipe and similar
};

/// Returns the reason why the device cannot mesh, as a sentence: the first missing feature or limit. Empty if it can
/// mesh. Pure.
std::string unsupportedReason(const DeviceInfo& info);

/// Ranks device types by their likely speed: discrete 4, integrated 3, virtual 2, software 1, others 0.
int rankOf(VkPhysicalDeviceType type);

DeviceInfo describe(const InstanceTable& calls, VkPhysicalDevice device);

/// Lists all devices of this machine, including unusable ones; an empty list is not an error. Errors: same as
/// Instance::create.
Result<std::vector<DeviceInfo>> listDevices();

}  // namespace sgm::vulkan
