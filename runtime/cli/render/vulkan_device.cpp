#include "render/vulkan_device.h"

#include <dlfcn.h>

#include <array>
#include <cstring>
#include <utility>

namespace sgm {
namespace {

constexpr uint32_t kApiVersion = VK_API_VERSION_1_2;
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr uint64_t kTimeoutNanoseconds = 600'000'000'000;  // software Vulkan may need minutes for a huge scene

// The loader stays in memory once opened: drivers keep thread-local destructors that must outlive every thread.
Result<VulkanGlobalTable> openLoader() {
  void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    return Error{Code::unsupported, "no Vulkan loader here: install the packages libvulkan1 and mesa-vulkan-drivers"};
  }
  VulkanGlobalTable table;
  table.vkGetInstanceProcAddr = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
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

bool loadInstance(const VulkanGlobalTable& global, VkInstance instance, VulkanInstanceTable& table) {
  bool complete = true;
#define SGM_LOAD(name) table.name = reinterpret_cast<PFN_##name>(global.vkGetInstanceProcAddr(instance, #name));
  SGM_VK_INSTANCE(SGM_LOAD)
  SGM_VK_INSTANCE_DEBUG(SGM_LOAD)
#undef SGM_LOAD
#define SGM_CHECK(name) complete = complete && table.name;
  SGM_VK_INSTANCE(SGM_CHECK)
#undef SGM_CHECK
  return complete;
}

bool loadDevice(const VulkanInstanceTable& instance, VkDevice device, VulkanDeviceTable& table) {
  bool complete = true;
#define SGM_LOAD(name)                                                                    \
  table.name = reinterpret_cast<PFN_##name>(instance.vkGetDeviceProcAddr(device, #name)); \
  complete = complete && table.name;
  SGM_VK_DEVICE(SGM_LOAD)
#undef SGM_LOAD
  return complete;
}

GpuInfo describe(const VulkanInstanceTable& calls, VkPhysicalDevice device) {
  VkPhysicalDeviceFloatControlsProperties floats{};
  floats.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &floats;
  calls.vkGetPhysicalDeviceProperties2(device, &properties);
  GpuInfo info;
  info.name = properties.properties.deviceName;
  info.type = properties.properties.deviceType;
  info.api_version = properties.properties.apiVersion;
  info.software = info.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
  info.rounds_to_nearest = floats.shaderRoundingModeRTEFloat32 == VK_TRUE;
  info.preserves_denormals = floats.shaderDenormPreserveFloat32 == VK_TRUE;
  return info;
}

int rank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 1;
    default:
      return 0;
  }
}

// Devices too old for us are left out, so that indices count what can be used.
Result<std::vector<VkPhysicalDevice>> usableDevices(const VulkanInstanceTable& calls, VkInstance instance) {
  uint32_t count = 0;
  VkResult result = calls.vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> all(count);
  if (result == VK_SUCCESS && count) result = calls.vkEnumeratePhysicalDevices(instance, &count, all.data());
  if (result < 0) return vulkanError(result, "listing Vulkan devices");
  std::vector<VkPhysicalDevice> usable;
  for (VkPhysicalDevice device : all) {
    VkPhysicalDeviceProperties properties;
    calls.vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.apiVersion >= kApiVersion) usable.push_back(device);
  }
  if (usable.empty()) {
    return Error{Code::unsupported,
                 "no Vulkan 1.2 device here: install your GPU's driver, or mesa-vulkan-drivers for software Vulkan"};
  }
  return usable;
}

}  // namespace

Error vulkanError(VkResult result, const std::string& what) {
  const std::string number = " (VkResult " + std::to_string(static_cast<int>(result)) + ")";
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return {Code::out_of_memory, what + ": out of memory" + number};
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return {Code::out_of_memory, what + ": the GPU is out of memory" + number};
    case VK_ERROR_DEVICE_LOST:
      return {Code::unsupported, what + ": the Vulkan device was lost" + number};
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return {Code::unsupported,
              what + ": no Vulkan driver here: install your GPU's driver, or mesa-vulkan-drivers" + number};
    case VK_TIMEOUT:
      return {Code::unsupported, what + ": the Vulkan device did not finish in time" + number};
    default:
      return {Code::unsupported, what + ": Vulkan refused" + number};
  }
}

struct VulkanDeviceBuilder {
  static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                  VkDebugUtilsMessageTypeFlagsEXT,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto* messages = static_cast<VulkanDevice::Messages*>(user);
    const std::scoped_lock lock(messages->mutex);
    messages->texts.emplace_back(data->pMessage ? data->pMessage : "");
    return VK_FALSE;
  }

  static Result<void> openInstance(VulkanDevice& device, bool validation) {
    auto global = openLoader();
    if (!global) return global.error();
    device.global_calls_ = *global;
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "sgm";
    application.apiVersion = kApiVersion;
    VkDebugUtilsMessengerCreateInfoEXT debug{};
    debug.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    debug.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    debug.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    debug.pfnUserCallback = onMessage;
    debug.pUserData = device.messages_.get();
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (validation) {
      info.pNext = &debug;
      info.enabledLayerCount = 1;
      info.ppEnabledLayerNames = &kValidationLayer;
      info.enabledExtensionCount = 1;
      info.ppEnabledExtensionNames = &extension;
    }
    const VkResult result = global->vkCreateInstance(&info, nullptr, &device.instance_);
    if (result == VK_ERROR_LAYER_NOT_PRESENT) {
      return Error{Code::unsupported, "no Vulkan validation layer here: install the package vulkan-validationlayers"};
    }
    if (result != VK_SUCCESS) return vulkanError(result, "creating a Vulkan instance");
    if (!loadInstance(*global, device.instance_, device.instance_calls_)) {
      return Error{Code::unsupported, "the Vulkan loader lacks functions of Vulkan 1.2: update the package libvulkan1"};
    }
    if (validation && device.instance_calls_.vkCreateDebugUtilsMessengerEXT) {
      const VkResult made =
          device.instance_calls_.vkCreateDebugUtilsMessengerEXT(device.instance_, &debug, nullptr, &device.messenger_);
      if (made != VK_SUCCESS) return vulkanError(made, "listening to the validation layer");
    }
    return {};
  }

  static Result<void> choose(VulkanDevice& device, int index) {
    auto usable = usableDevices(device.instance_calls_, device.instance_);
    if (!usable) return usable.error();
    const int count = static_cast<int>(usable->size());
    if (index >= count) {
      return Error{Code::unsupported, "no Vulkan device " + std::to_string(index) + ": there are " +
                                          std::to_string(count) + ", counted from 0"};
    }
    size_t chosen = 0;
    if (index >= 0) {
      chosen = static_cast<size_t>(index);
    } else {
      int best = -1;
      for (size_t i = 0; i < usable->size(); ++i) {
        const int r = rank(describe(device.instance_calls_, (*usable)[i]).type);
        if (r > best) best = r, chosen = i;
      }
    }
    device.physical_ = (*usable)[chosen];
    device.info_ = describe(device.instance_calls_, device.physical_);
    VkPhysicalDeviceProperties properties;
    device.instance_calls_.vkGetPhysicalDeviceProperties(device.physical_, &properties);
    device.limits_ = properties.limits;
    return {};
  }

  static Result<void> openDevice(VulkanDevice& device) {
    const VulkanInstanceTable& calls = device.instance_calls_;
    uint32_t count = 0;
    calls.vkGetPhysicalDeviceQueueFamilyProperties(device.physical_, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    calls.vkGetPhysicalDeviceQueueFamilyProperties(device.physical_, &count, families.data());
    constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    bool found = false;
    for (uint32_t i = 0; i < count && !found; ++i) {
      if ((families[i].queueFlags & kWanted) == kWanted) device.family_ = i, found = true;
    }
    if (!found) return Error{Code::unsupported, device.info_.name + " has no queue that both draws and computes"};
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = device.family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    const VkResult result = calls.vkCreateDevice(device.physical_, &info, nullptr, &device.device_);
    if (result != VK_SUCCESS) return vulkanError(result, "opening " + device.info_.name);
    if (!loadDevice(calls, device.device_, device.calls_)) {
      return Error{Code::unsupported, "the driver of " + device.info_.name + " lacks functions of Vulkan 1.2"};
    }
    device.calls_.vkGetDeviceQueue(device.device_, device.family_, 0, &device.queue_);
    return {};
  }
};

Result<std::unique_ptr<VulkanDevice>> VulkanDevice::create(const GpuOptions& options) {
  std::unique_ptr<VulkanDevice> device(new VulkanDevice);
  if (auto opened = VulkanDeviceBuilder::openInstance(*device, options.validation); !opened) return opened.error();
  if (auto chosen = VulkanDeviceBuilder::choose(*device, options.index); !chosen) return chosen.error();
  if (auto opened = VulkanDeviceBuilder::openDevice(*device); !opened) return opened.error();
  return device;
}

VulkanDevice::~VulkanDevice() {
  if (device_ && calls_.vkDestroyDevice) {
    calls_.vkDeviceWaitIdle(device_);
    calls_.vkDestroyDevice(device_, nullptr);
  }
  if (messenger_) instance_calls_.vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
  if (instance_ && instance_calls_.vkDestroyInstance) instance_calls_.vkDestroyInstance(instance_, nullptr);
}

std::vector<std::string> VulkanDevice::messages() const {
  const std::scoped_lock lock(messages_->mutex);
  return messages_->texts;
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
    if (result != VK_SUCCESS) calls_.vkDeviceWaitIdle(device_);  // what is destroyed below may still be in use
  }
  calls_.vkDestroyFence(device_, fence, nullptr);
  calls_.vkDestroyCommandPool(device_, pool, nullptr);
  if (result != VK_SUCCESS) return vulkanError(result, "running commands on " + info_.name);
  return {};
}

Result<std::vector<GpuInfo>> listGpus() {
  auto global = openLoader();
  if (!global) return global.error();
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = kApiVersion;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = global->vkCreateInstance(&info, nullptr, &instance);
  if (result != VK_SUCCESS) return vulkanError(result, "creating a Vulkan instance");
  VulkanInstanceTable calls;
  if (!loadInstance(*global, instance, calls)) {
    if (calls.vkDestroyInstance) calls.vkDestroyInstance(instance, nullptr);
    return Error{Code::unsupported, "the Vulkan loader lacks functions of Vulkan 1.2: update the package libvulkan1"};
  }
  auto usable = usableDevices(calls, instance);
  std::vector<GpuInfo> infos;
  if (usable) {
    for (VkPhysicalDevice device : *usable) infos.push_back(describe(calls, device));
  }
  calls.vkDestroyInstance(instance, nullptr);
  if (!usable) return usable.error();
  return infos;
}

}  // namespace sgm
