#pragma once
// Fills the function tables, and says what a failed Vulkan call means.

#include <string>

#include "backend/vulkan/tables.h"
#include "base/result.h"

namespace sgm::vulkan {

/// Opens libvulkan.so.1, which stays in memory: drivers keep thread-local destructors that must outlive every thread.
/// Error: unsupported, with what to install.
Result<GlobalTable> openLoader();

/// false: a function of Vulkan 1.2 is missing. What was there is in the table all the same, so that the instance can be
/// destroyed.
bool loadInstance(PFN_vkGetInstanceProcAddr resolve, VkInstance instance, InstanceTable& table);
/// As loadInstance.
bool loadDevice(const InstanceTable& instance, VkDevice device, DeviceTable& table);

/// The text and Code for a failed call; `what` says what was being done. device_lost where the device was lost: then
/// nothing that was made with it works any more, and all that can be done is to destroy it.
Error errorOf(VkResult result, const std::string& what);

}  // namespace sgm::vulkan
