#include "backend/vulkan/device.h"

#include <cstring>

#include "backend/vulkan/memory.h"

namespace sgm::vulkan {
namespace {

bool hasExtension(const InstanceTable& calls, VkPhysicalDevice device, const char* name) {
  uint32_t count = 0;
  if (calls.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkExtensionProperties> extensions(count);
  if (calls.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()) != VK_SUCCESS)
    return false;
  for (const VkExtensionProperties& extension : extensions) {
    if (std::strcmp(extension.extensionName, name) == 0) return true;
  }
  return false;
}

}  // namespace

Result<std::unique_ptr<Device>> Device::open(const OwnDevice& options) {
  auto instance = Instance::create({options.validation, options.log, options.replace_instance_calls});
  if (!instance) return instance.error();
  std::unique_ptr<Device> device(new Device);
  device->instance_ = std::move(*instance);
  device->instance_calls_ = device->instance_->calls();
  if (auto chosen = device->choose(options); !chosen) return chosen.error();
  if (auto opened = device->openDevice(); !opened) return opened.error();
  if (auto loaded = device->load(options.replace_calls); !loaded) return loaded.error();
  device->calls_.vkGetDeviceQueue(device->device_, device->family_, 0, &device->queue_);
  return device;
}

Result<std::unique_ptr<Device>> Device::borrow(const BorrowedDevice& engine) {
  if (!engine.get_instance_proc_addr || !engine.instance || !engine.physical || !engine.device || !engine.queue) {
    return Error{Code::invalid_argument,
                 "an external Vulkan device needs vkGetInstanceProcAddr, instance, physical device, device and queue"};
  }
  if (!engine.lock != !engine.unlock) {
    return Error{Code::invalid_argument,
                 "an external Vulkan queue needs both a lock and an unlock function, or neither"};
  }
  if (engine.api_version < VK_API_VERSION_1_2) {
    return Error{Code::unsupported,
                 "the engine's Vulkan instance was created for a version below Vulkan 1.2: its apiVersion is " +
                     std::to_string(VK_API_VERSION_MAJOR(engine.api_version)) + "." +
                     std::to_string(VK_API_VERSION_MINOR(engine.api_version))};
  }
  if (!engine.timeline_semaphores) {
    return Error{Code::unsupported, "the engine's Vulkan device lacks the feature timelineSemaphore: enable it"};
  }
  std::unique_ptr<Device> device(new Device);
  if (!loadInstance(engine.get_instance_proc_addr, engine.instance, device->instance_calls_)) {
    return Error{Code::unsupported, "the engine's Vulkan instance lacks functions of Vulkan 1.2"};
  }
  device->adopt(engine.physical);
  if (std::string lack = unsupportedReason(device->info_); !lack.empty())
    return Error{Code::unsupported, std::move(lack)};
  uint32_t count = 0;
  device->instance_calls_.vkGetPhysicalDeviceQueueFamilyProperties(engine.physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  device->instance_calls_.vkGetPhysicalDeviceQueueFamilyProperties(engine.physical, &count, families.data());
  std::vector<uint32_t> named = engine.readers;
  named.push_back(engine.family);
  for (const uint32_t family : named) {
    if (family < count) continue;
    return Error{Code::invalid_argument, device->info_.name + " has no queue family " + std::to_string(family)};
  }
  if (!(families[engine.family].queueFlags & VK_QUEUE_COMPUTE_BIT)) {
    return Error{Code::unsupported,
                 "the engine's Vulkan queue does not support compute: lend a queue of another family"};
  }
  device->device_ = engine.device;
  device->queue_ = engine.queue;
  device->family_ = engine.family;
  device->readers_ = engine.readers;
  device->memory_budget_ = engine.memory_budget;
  device->external_memory_ = engine.external_memory;
  if (engine.queue_mutex) device->queue_mutex_ = engine.queue_mutex;
  device->lock_ = engine.lock;
  device->unlock_ = engine.unlock;
  device->user_ = engine.user;
  if (auto loaded = device->load(engine.replace_calls); !loaded) return loaded.error();
  if (engine.external_memory && !device->calls_.vkGetMemoryFdKHR) {
    return Error{Code::unsupported,
                 "the engine's Vulkan device was created without the extension VK_KHR_external_memory_fd: enable it, "
                 "or set external_memory to 0"};
  }
  if (engine.external_memory && !sharedMemoryNeeds(*device)) {
    return Error{Code::unsupported, device->info_.name + " cannot share memory with other APIs"};
  }
  return device;
}

Device::~Device() {
  if (borrowed() || !device_ || !calls_.vkDestroyDevice) return;
  calls_.vkDeviceWaitIdle(device_);
  calls_.vkDestroyDevice(device_, nullptr);
}

std::vector<std::string> Device::messages() const {
  return instance_ ? instance_->messages() : std::vector<std::string>();
}

Result<void> Device::choose(const OwnDevice& options) {
  const auto devices = instance_->devices();
  if (!devices) return devices.error();
  if (devices->empty()) {
    return Error{Code::unsupported,
                 "there is no Vulkan device: install your GPU's driver, or mesa-vulkan-drivers for software Vulkan"};
  }
  const int count = static_cast<int>(devices->size());
  if (options.index >= count) {
    return Error{Code::unsupported, "there is no Vulkan device " + std::to_string(options.index) + ": there are " +
                                        std::to_string(count) + ", counted from 0"};
  }
  if (options.index >= 0) {
    adopt((*devices)[static_cast<size_t>(options.index)]);
    if (std::string lack = unsupportedReason(info_); !lack.empty()) return Error{Code::unsupported, std::move(lack)};
    return {};
  }
  int best = -1;
  std::string lacks;
  VkPhysicalDevice chosen = VK_NULL_HANDLE;
  for (VkPhysicalDevice device : *devices) {
    const DeviceInfo info = describe(instance_calls_, device);
    std::string lack = unsupportedReason(info);
    if (lack.empty() && info.software() && !options.software) {
      lack = info.name + " runs on the CPU and was not requested";
    }
    if (!lack.empty()) {
      lacks += "; " + lack;
    } else if (rankOf(info.type) > best) {
      best = rankOf(info.type);
      chosen = device;
    }
  }
  if (!chosen) return Error{Code::unsupported, "there is no usable Vulkan device" + lacks};
  adopt(chosen);
  return {};
}

void Device::adopt(VkPhysicalDevice physical) {
  physical_ = physical;
  info_ = describe(instance_calls_, physical);
  VkPhysicalDeviceProperties properties;
  instance_calls_.vkGetPhysicalDeviceProperties(physical, &properties);
  limits_ = properties.limits;
}

Result<void> Device::openDevice() {
  uint32_t count = 0;
  instance_calls_.vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  instance_calls_.vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  // A queue family without graphics is preferred, because it computes concurrently with drawing.
  bool drawing = true;
  for (uint32_t i = 0; i < count && drawing; ++i) {
    const VkQueueFlags flags = families[i].queueFlags;
    if (!(flags & VK_QUEUE_COMPUTE_BIT) || (flags & VK_QUEUE_GRAPHICS_BIT)) continue;
    family_ = i;
    drawing = false;
  }
  for (uint32_t i = count; drawing && i-- > 0;) {
    if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) family_ = i;
  }
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceTimelineSemaphoreFeatures timeline{};
  timeline.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES;
  timeline.timelineSemaphore = VK_TRUE;
  const char* budget = VK_EXT_MEMORY_BUDGET_EXTENSION_NAME;
  memory_budget_ = hasExtension(instance_calls_, physical_, budget);
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &timeline;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = memory_budget_ ? 1 : 0;
  info.ppEnabledExtensionNames = &budget;
  const VkResult result = instance_calls_.vkCreateDevice(physical_, &info, nullptr, &device_);
  if (result != VK_SUCCESS) return errorOf(result, "opening " + info_.name);
  return {};
}

Result<void> Device::load(const ReplaceCalls& replace) {
  if (!loadDevice(instance_calls_, device_, calls_)) {
    return Error{Code::unsupported, "the driver of " + info_.name + " lacks functions of Vulkan 1.2"};
  }
  if (replace) replace(calls_);
  return {};
}

}  // namespace sgm::vulkan
