#pragma once
// Simulates a device that shares no memory with the host; the actual device shares all of its memory. The simulated
// device reports three types of memory: the device's own memory, which cannot be mapped, and host memory, either
// coherent or cached. Mapping the cached memory gives a copy, which changes only when it is invalidated. The state is
// static, like that of Faults, so only one simulation may exist at a time.

#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "backend/vulkan/device.h"

namespace sgm::vulkan {

class FarDevice {
 public:
  /// Installs the simulation in an engine's device. Precondition: MemoryOptions::apart is set.
  static void wrap(BorrowedDevice& external) {
    state().resolver = external.get_instance_proc_addr;
    external.get_instance_proc_addr = resolve;
  }
  static void wrap(DeviceTable& table) {
    state().calls = table;
    table.vkGetBufferMemoryRequirements = [](VkDevice device, VkBuffer buffer, VkMemoryRequirements* needs) {
      state().calls.vkGetBufferMemoryRequirements(device, buffer, needs);
      needs->memoryTypeBits = (1 << kTypes) - 1;
    };
    table.vkAllocateMemory = allocate;
    table.vkFreeMemory = free;
    table.vkMapMemory = map;
    table.vkInvalidateMappedMemoryRanges = invalidate;
  }
  static unsigned invalidations() {
    const std::scoped_lock lock(state().mutex);
    return state().invalidations;
  }

 private:
  enum Type : uint32_t { kOwn, kCoherent, kCached, kTypes };
  struct Allocation {
    uint32_t type;
    std::vector<std::byte> copy;
    std::byte* data;
  };
  struct State {
    std::mutex mutex;
    PFN_vkGetInstanceProcAddr resolver = nullptr;
    DeviceTable calls;
    std::map<VkDeviceMemory, Allocation> memory;
    unsigned invalidations = 0;
  };
  static State& state() {
    static State one;
    return one;
  }

  static VKAPI_ATTR void VKAPI_CALL types(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* memory) {
    *memory = {};
    memory->memoryTypeCount = kTypes;
    memory->memoryTypes[kOwn] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    memory->memoryTypes[kCoherent] = {VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, 1};
    memory->memoryTypes[kCached] = {VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, 1};
    memory->memoryHeapCount = 2;
    memory->memoryHeaps[0] = {uint64_t{1} << 32, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
    memory->memoryHeaps[1] = {uint64_t{1} << 32, 0};
  }
  static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL resolve(VkInstance instance, const char* name) {
    if (std::string(name) != "vkGetPhysicalDeviceMemoryProperties") return state().resolver(instance, name);
    return reinterpret_cast<PFN_vkVoidFunction>(types);
  }
  static VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                                 const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
    VkMemoryAllocateInfo real = *info;
    real.memoryTypeIndex = 0;
    const VkResult result = state().calls.vkAllocateMemory(device, &real, allocator, memory);
    if (result != VK_SUCCESS) return result;
    const std::scoped_lock lock(state().mutex);
    const size_t copied = info->memoryTypeIndex == kCached ? info->allocationSize : 0;
    state().memory[*memory] = {info->memoryTypeIndex, std::vector<std::byte>(copied, std::byte{0xCD}), nullptr};
    return result;
  }
  static VKAPI_ATTR void VKAPI_CALL free(VkDevice device, VkDeviceMemory memory,
                                         const VkAllocationCallbacks* allocator) {
    {
      const std::scoped_lock lock(state().mutex);
      state().memory.erase(memory);
    }
    state().calls.vkFreeMemory(device, memory, allocator);
  }
  static VKAPI_ATTR VkResult VKAPI_CALL map(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                            VkDeviceSize size, VkMemoryMapFlags flags, void** data) {
    const std::scoped_lock lock(state().mutex);
    Allocation& allocation = state().memory.at(memory);
    if (allocation.type == kOwn) return VK_ERROR_MEMORY_MAP_FAILED;
    const VkResult result = state().calls.vkMapMemory(device, memory, offset, size, flags, data);
    allocation.data = static_cast<std::byte*>(*data);
    if (result == VK_SUCCESS && allocation.type == kCached) *data = allocation.copy.data();
    return result;
  }
  static VKAPI_ATTR VkResult VKAPI_CALL invalidate(VkDevice device, uint32_t count, const VkMappedMemoryRange* ranges) {
    const std::scoped_lock lock(state().mutex);
    for (uint32_t i = 0; i < count; ++i) {
      Allocation& allocation = state().memory.at(ranges[i].memory);
      std::memcpy(allocation.copy.data() + ranges[i].offset, allocation.data + ranges[i].offset, ranges[i].size);
    }
    ++state().invalidations;
    return state().calls.vkInvalidateMappedMemoryRanges(device, count, ranges);
  }
};

}  // namespace sgm::vulkan
