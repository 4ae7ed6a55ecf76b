#include "backend/vulkan/loader.h"

#include "base/platform/library.h"

namespace sgm::vulkan {

Result<GlobalTable> openLoader() {
  void* library = platform::openLibrary("libvulkan.so.1");
  if (!library) {
    return Error{Code::unsupported,
                 "the Vulkan loader is missing: install the packages libvulkan1 and mesa-vulkan-drivers"};
  }
  GlobalTable table;
  table.vkGetInstanceProcAddr =
      reinterpret_cast<PFN_vkGetInstanceProcAddr>(platform::symbolOf(library, "vkGetInstanceProcAddr"));
  if (!table.vkGetInstanceProcAddr) return Error{Code::unsupported, "libvulkan.so.1 is damaged: reinstall libvulkan1"};
  bool complete = true;
#define SGM_LOAD(name)                                                                           \
  table.name = reinterpret_cast<PFN_##name>(table.vkGetInstanceProcAddr(VK_NULL_HANDLE, #name)); \
  complete = complete && table.name;
  SGM_VK_GLOBAL(SGM_LOAD)
#undef SGM_LOAD
  if (!complete) return Error{Code::unsupported, "the Vulkan loader is older than 1.1: update the package libvulkan1"};
  return table;
}

bool loadInstance(PFN_vkGetInstanceProcAddr resolve, VkInstance instance, InstanceTable& table) {
  bool complete = true;
#define SGM_LOAD(name) table.name = reinterpret_cast<PFN_##name>(resolve(instance, #name));
  SGM_VK_INSTANCE(SGM_LOAD)
  SGM_VK_INSTANCE_DEBUG(SGM_LOAD)
#undef SGM_LOAD
#define SGM_CHECK(name) complete = complete && table.name;
  SGM_VK_INSTANCE(SGM_CHECK)
#undef SGM_CHECK
  return complete;
}

bool loadDevice(const InstanceTable& instance, VkDevice device, DeviceTable& table) {
  bool complete = true;
#define SGM_LOAD(name)                                                                    \
  table.name = reinterpret_cast<PFN_##name>(instance.vkGetDeviceProcAddr(device, #name)); \
  complete = complete && table.name;
  SGM_VK_DEVICE(SGM_LOAD)
#undef SGM_LOAD
#define SGM_LOAD(name) table.name = reinterpret_cast<PFN_##name>(instance.vkGetDeviceProcAddr(device, #name));
  SGM_VK_DEVICE_EXTENSIONS(SGM_LOAD)
#undef SGM_LOAD
  return complete;
}

Error errorOf(VkResult result, const std::string& what) {
  const std::string number = " (VkResult " + std::to_string(static_cast<int>(result)) + ")";
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return {Code::out_of_memory, what + ": out of memory" + number};
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return {Code::out_of_memory, what + ": the GPU is out of memory" + number};
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
      return {Code::out_of_memory, what + ": a descriptor pool is exhausted" + number};
    case VK_ERROR_MEMORY_MAP_FAILED:
      return {Code::out_of_memory, what + ": there is no address space to map the GPU's memory" + number};
    case VK_ERROR_TOO_MANY_OBJECTS:
      return {Code::limit, what + ": too many objects of this kind" + number};
    case VK_ERROR_DEVICE_LOST:
      return {Code::device_lost, what + ": the Vulkan device was lost" + number};
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return {Code::unsupported,
              what + ": there is no Vulkan driver: install your GPU's driver, or mesa-vulkan-drivers" + number};
    case VK_TIMEOUT:
      return {Code::unsupported, what + ": the Vulkan device did not finish in time" + number};
    default:
      return {Code::unsupported, what + ": the Vulkan call failed" + number};
  }
}

}  // namespace sgm::vulkan
