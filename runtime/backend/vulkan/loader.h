#pragma once
// Fills the function tables, and converts Vulkan results to errors.

#include <string>

#include "backend/vulkan/tables.h"
#include "base/result.h"

namespace sgm::vulkan {

/// Opens libvulkan.so.1, which is never unloaded: drivers have thread-local destructors that must outlive every thread.
/// Error: unsupported; the message says what to install.
Result<GlobalTable> openLoader();

/// Returns false if a function of Vulkan 1.2 is missing. The table still has the other functions, so that the instance
/// can be destroyed.
bool loadInstance(PFN_vkGetInstanceProcAddr resolve, VkInstance instance, InstanceTable& table);
/// As loadInstance.
bool loadDevice(const InstanceTable& instance, VkDevice device, DeviceTable& table);

/// The error for a failed call; `what` names the action. device_lost if the device was lost: then everything made with
/// it can only be destroyed.
Error errorOf(VkResult result, const std::string& what);

}  // namespace sgm::vulkan
