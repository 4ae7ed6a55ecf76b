#pragma once
// Loads Vulkan's function pointers into tables, and converts VkResult codes to errors.

#include <string>

#include "backend/vulkan/tables.h"
#include "base/result.h"

namespace sgm::vulkan {

/// Opens libvulkan.so.1 and never closes it: drivers have thread-local destructors, so their code must stay loaded as
/// long as any thread exists. Error: unsupported; the message says what to install.
Result<GlobalTable> openLoader();

/// Fills the table of an instance. Returns false if a function of Vulkan 1.2 is missing; the table then still contains
/// all other functions, so that the instance can be destroyed.
bool loadInstance(PFN_vkGetInstanceProcAddr resolve, VkInstance instance, InstanceTable& table);
/// Same as loadInstance, for the table of a device.
bool loadDevice(const InstanceTable& instance, VkDevice device, DeviceTable& table);

/// Converts the result of a failed call to an error; `what` names the action. The code is device_lost if the device was
/// lost: then everything created with the device can only be destroyed.
Error errorOf(VkResult result, const std::string& what);

}  // namespace sgm::vulkan
