#include "tools/render/vulkan_device.h"

#include <utility>

namespace sgm {
namespace {

constexpr uint64_t kTimeoutNanoseconds = 600'000'000'000;  // ten minutes: a software device may need minutes for a huge
                                                           // scene

bool loadDrawing(const vulkan::InstanceTable& instance, VkDevice device, DrawingTable& table) {
  bool complete = vulkan::loadDevice(instance, device, table);
#define SGM_LOAD(name)                                                                    \
  table.name = reinterpret_cast<PFN_##name>(instance.vkGetDeviceProcAddr(device, #name)); \
  complete = complete && table.name;
  SGM_VK_DRAWING(SGM_LOAD)
#undef SGM_LOAD
  return complete;
}

// The devices that support Vulkan 1.2. Other devices are not listed, so that they do not count in GpuOptions::index.
Result<std::vector<VkPhysicalDevice>> usableDevices(const vulkan::Instance& instance) {
  auto all = instance.devices();
  if (!all) return all.error();
  std::vector<VkPhysicalDevice> usable;
  for (VkPhysicalDevice device : *all) {
    VkPhysicalDeviceProperties properties;
    instance.calls().vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.apiVersion >= VK_API_VERSION_1_2) usable.push_back(device);
  }
  if (usable.empty()) {
    return Error{
        Code::unsupported,
        "there is no Vulkan 1.2 device: install your GPU's driver, or mesa-vulkan-drivers for software Vulkan"};
  }
  return usable;
}

}  // namespace

Result<std::unique_ptr<VulkanDevice>> VulkanDevice::create(const GpuOptions& options) {
  auto instance = vulkan::Instance::create({options.validation ? vulkan::Validation::core : vulkan::Validation::none});
  if (!instance) return instance.error();
  std::unique_ptr<VulkanDevice> device(new VulkanDevice);
  device->instance_ = std::move(*instance);
  if (auto chosen = device->choose(options.index); !chosen) return chosen.error();
  if (auto opened = device->open(); !opened) return opened.error();
  return device;
}

Result<void> VulkanDevice::choose(int index) {
  auto usable = usableDevices(*instance_);
  if (!usable) return usable.error();
  const int count = static_cast<int>(usable->size());
  if (index >= count) {
    return Error{Code::unsupported, "there is no Vulkan device " + std::to_string(index) + ": there are " +
                                        std::to_string(count) + ", counted from 0"};
  }
  size_t chosen = 0;
  if (index >= 0) {
    chosen = static_cast<size_t>(index);
  } else {
    int best = -1;
    for (size_t i = 0; i < usable->size(); ++i) {
      const int rank = vulkan::rankOf(vulkan::describe(instanceCalls(), (*usable)[i]).type);
      if (rank > best) best = rank, chosen = i;
    }
  }
  physical_ = (*usable)[chosen];
  info_ = vulkan::describe(instanceCalls(), physical_);
  VkPhysicalDeviceProperties properties;
  instanceCalls().vkGetPhysicalDeviceProperties(physical_, &properties);
  limits_ = properties.limits;
  return {};
}

Result<void> VulkanDevice::open() {
  const vulkan::InstanceTable& calls = instanceCalls();
  uint32_t count = 0;
  calls.vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  calls.vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  bool found = false;
  for (uint32_t i = 0; i < count && !found; ++i) {
    if ((families[i].queueFlags & kWanted) == kWanted) family_ = i, found = true;
  }
  if (!found) return Error{Code::unsupported, info_.name + " has no queue that both draws and computes"};
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  const VkResult result = calls.vkCreateDevice(physical_, &info, nullptr, &device_);
  if (result != VK_SUCCESS) return vulkan::errorOf(result, "opening " + info_.name);
  if (!loadDrawing(calls, device_, calls_)) {
    return Error{Code::unsupported, "the driver of " + info_.name + " lacks functions of Vulkan 1.2"};
  }
  calls_.vkGetDeviceQueue(device_, family_, 0, &queue_);
  return {};
}

VulkanDevice::~VulkanDevice() {
  if (!device_ || !calls_.vkDestroyDevice) return;
  calls_.vkDeviceWaitIdle(device_);
  calls_.vkDestroyDevice(device_, nullptr);
}

Result<void> VulkanDevice::run(const std::function<void(VkCommandBuffer)>& record) const {
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.queueFamilyIndex = family_;
  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  VkResult result = calls_.vkCreateCommandPool(device_, &pool_info, nullptr, &pool);
  if (result == VK_SUCCESS) result = calls_.vkCreateFence(device_, &fence_info, nullptr, &fence);
  VkCommandBuffer commands = VK_NULL_HANDLE;
  if (result == VK_SUCCESS) {
    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = pool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    result = calls_.vkAllocateCommandBuffers(device_, &allocate, &commands);
  }
  if (result == VK_SUCCESS) {
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    result = calls_.vkBeginCommandBuffer(commands, &begin);
  }
  if (result == VK_SUCCESS) {
    record(commands);
    result = calls_.vkEndCommandBuffer(commands);
  }
  if (result == VK_SUCCESS) {
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    result = calls_.vkQueueSubmit(queue_, 1, &submit, fence);
    if (result == VK_SUCCESS) result = calls_.vkWaitForFences(device_, 1, &fence, VK_TRUE, kTimeoutNanoseconds);
    // After an error, the device may still use the objects that are destroyed below.
    if (result != VK_SUCCESS) calls_.vkDeviceWaitIdle(device_);
  }
  calls_.vkDestroyFence(device_, fence, nullptr);
  calls_.vkDestroyCommandPool(device_, pool, nullptr);
  if (result != VK_SUCCESS) return vulkan::errorOf(result, "running commands on " + info_.name);
  return {};
}

Result<std::vector<vulkan::DeviceInfo>> listGpus() {
  const auto instance = vulkan::Instance::create();
  if (!instance) return instance.error();
  const auto usable = usableDevices(**instance);
  if (!usable) return usable.error();
  std::vector<vulkan::DeviceInfo> infos;
  for (VkPhysicalDevice device : *usable) infos.push_back(vulkan::describe((*instance)->calls(), device));
  return infos;
}

}  // namespace sgm
