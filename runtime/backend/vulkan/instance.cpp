#include "backend/vulkan/instance.h"

#include <array>

namespace sgm::vulkan {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr std::array<const char*, 2> kValidationExtensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                                           VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
constexpr std::array<VkValidationFeatureEnableEXT, 3> kFurtherChecks{
    VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT, VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT,
    VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT};

uint32_t furtherChecks(Validation validation) {
  if (validation == Validation::gpu_assisted) return 3;
  return validation == Validation::synchronization ? 1 : 0;
}

}  // namespace

VKAPI_ATTR VkBool32 VKAPI_CALL Instance::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                   VkDebugUtilsMessageTypeFlagsEXT,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  static_cast<MessageLog*>(user)->add(data->pMessage ? data->pMessage : "");
  return VK_FALSE;
}

Result<std::unique_ptr<Instance>> Instance::create(const InstanceOptions& options) {
  std::unique_ptr<Instance> instance(new Instance);
  instance->log_ = options.log ? options.log : std::make_shared<MessageLog>();
  if (auto opened = instance->open(options); !opened) return opened.error();
  return instance;
}

Result<void> Instance::open(const InstanceOptions& options) {
  const auto global = openLoader();
  if (!global) return global.error();
  resolver_ = global->vkGetInstanceProcAddr;
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "sgm";
  application.apiVersion = VK_API_VERSION_1_2;
  VkDebugUtilsMessengerCreateInfoEXT debug{};
  debug.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  debug.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  debug.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  debug.pfnUserCallback = onMessage;
  debug.pUserData = log_.get();
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.pNext = &debug;
  features.enabledValidationFeatureCount = furtherChecks(options.validation);
  features.pEnabledValidationFeatures = kFurtherChecks.data();
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  const bool watched = options.validation != Validation::none;
  if (watched) {
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = static_cast<uint32_t>(kValidationExtensions.size());
    info.ppEnabledExtensionNames = kValidationExtensions.data();
  }
  VkResult result = global->vkCreateInstance(&info, nullptr, &instance_);
  if (result == VK_ERROR_LAYER_NOT_PRESENT) {
    return Error{Code::unsupported,
                 "the Vulkan validation layer is missing: install the package vulkan-validationlayers"};
  }
  if (result != VK_SUCCESS) return errorOf(result, "creating a Vulkan instance");
  if (!loadInstance(resolver_, instance_, calls_)) {
    return Error{Code::unsupported, "the Vulkan loader lacks functions of Vulkan 1.2: update the package libvulkan1"};
  }
  if (options.replace_calls) options.replace_calls(calls_);
  if (watched) {
    result = calls_.vkCreateDebugUtilsMessengerEXT(instance_, &debug, nullptr, &messenger_);
    if (result != VK_SUCCESS) return errorOf(result, "registering for messages of the validation layer");
  }
  return {};
}

Instance::~Instance() {
  if (messenger_) calls_.vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
  if (instance_ && calls_.vkDestroyInstance) calls_.vkDestroyInstance(instance_, nullptr);
}

Result<std::vector<VkPhysicalDevice>> Instance::devices() const {
  uint32_t count = 0;
  VkResult result = calls_.vkEnumeratePhysicalDevices(instance_, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  if (result == VK_SUCCESS && count) result = calls_.vkEnumeratePhysicalDevices(instance_, &count, devices.data());
  if (result < 0) return errorOf(result, "listing Vulkan devices");
  devices.resize(count);  // shorter if a device has disappeared between the two calls
  return devices;
}

}  // namespace sgm::vulkan
