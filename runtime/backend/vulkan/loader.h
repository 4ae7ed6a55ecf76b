#pragma once
// Fills the function tables, and converts Vulkan results to errors.

#include <string>

#include "backend/vulkan/tables.h"
#include "base/result.h"

namespace sgm::vulkan {

/// Opens libvulkan.so.1, which is never closed: drivers have thread-local destructors, which must exist as long as
/// every thread. Error: unsupported; the message says what to install.
Result<GlobalTable> openLoader();

/// Fills the table of an instance. Returns false if a function of Vulkan 1.2 is missing; then the table still has the
/// others, so that the instance can be destroyed.
bool loadInstance(PFN_vkGetInstanceProcAddr resolve, VkInstance instance, InstanceTable& table);
/// Same as loadInstance, for the table of a device.
bool loadDevice(const InstanceTable& instance, VkDevice device, DeviceTable& table);

/// Converts the result of a failed call to an error; `what` names the action. The code is device_lost if the device was
/// lost: then everything created with the device can only be destroyed.
Error errorOf(VkResult result, const std::string& what);

}  // namespace sgm::vulkan
