#pragma once
// The engine's Vulkan instance, with the validation layer if requested.

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "vulkan_call.h"

/// Prints and counts the messages of the validation layer about calls of the engine and of the library. Thread-safe.
struct Validation {
  std::atomic<int> messages{0};

  VkDebugUtilsMessengerCreateInfoEXT listener() {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = show;
    info.pUserData = this;
    return info;
  }

 private:
  static VKAPI_ATTR VkBool32 VKAPI_CALL show(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                             const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    ++static_cast<Validation*>(user)->messages;
    std::fprintf(stderr, "external_vulkan: validation: %s\n", data->pMessage ? data->pMessage : "");
    return VK_FALSE;
  }
};

class VulkanInstance {
 public:
  static constexpr uint32_t kApiVersion = VK_API_VERSION_1_2;

  /// validation: receives the layer's messages, and must outlive the instance; null: the layer is not loaded. Throws
  /// NoDevice.
  explicit VulkanInstance(Validation* validation) {
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "external_vulkan";
    application.apiVersion = kApiVersion;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (!validation) {
      create(info);
      return;
    }
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    const VkValidationFeatureEnableEXT hazards = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    // Chained to the instance's description, so that it also reports messages about creating and destroying the
    // instance.
    const VkDebugUtilsMessengerCreateInfoEXT listener = validation->listener();
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &listener;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &hazards;
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = 2;
    info.ppEnabledExtensionNames = extensions;
    create(info);
    const auto listen = load<PFN_vkCreateDebugUtilsMessengerEXT>("vkCreateDebugUtilsMessengerEXT");
    const VkResult result = listen(instance_, &listener, nullptr, &messenger_);
    if (result == VK_SUCCESS) return;
    vkDestroyInstance(instance_, nullptr);
    must(result, "vkCreateDebugUtilsMessengerEXT");
  }
  VulkanInstance(const VulkanInstance&) = delete;
  VulkanInstance& operator=(const VulkanInstance&) = delete;
  ~VulkanInstance() {
    if (messenger_) {
      load<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_, nullptr);
    }
    vkDestroyInstance(instance_, nullptr);
  }

  VkInstance handle() const { return instance_; }

  std::vector<VkPhysicalDevice> devices() const {
    uint32_t count = 0;
    must(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    if (count > 0) must(vkEnumeratePhysicalDevices(instance_, &count, devices.data()), "vkEnumeratePhysicalDevices");
    return devices;
  }

 private:
  void create(const VkInstanceCreateInfo& info) {
    const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
    if (result == VK_ERROR_LAYER_NOT_PRESENT) {
      throw std::runtime_error("no validation layer here: install the package vulkan-validationlayers");
    }
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
      throw NoDevice("there is no Vulkan driver: install mesa-vulkan-drivers");
    must(result, "vkCreateInstance");
  }
  template <class Function>
  Function load(const char* name) const {
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance_, name));
  }

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};
