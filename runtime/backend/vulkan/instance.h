#pragma once
// The library's own Vulkan instance, and the messages of the validation layer.

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "backend/vulkan/loader.h"

namespace sgm::vulkan {

/// How much VK_LAYER_KHRONOS_validation checks; each level includes the previous ones.
enum class Validation : uint8_t {
  none,
  core,             ///< checks the arguments and states of every call
  synchronization,  ///< checks for missing barriers
  gpu_assisted,     ///< checks for shader accesses outside of their buffers; slow
};

/// Warnings and errors of the validation layer. Thread-safe.
class MessageLog {
 public:
  void add(const char* text) {
    const std::scoped_lock lock(mutex_);
    texts_.emplace_back(text);
  }
  std::vector<std::string> texts() const {
    const std::scoped_lock lock(mutex_);
    return texts_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> texts_;
};

struct InstanceOptions {
  Validation validation = Validation::none;
  /// Receives the messages of the validation layer, also those about objects that still exist when the instance is
  /// destroyed; null: the instance creates a log of its own.
  std::shared_ptr<MessageLog> log = nullptr;
  /// May replace entries of the function table before any call except vkCreateInstance; for tests.
  std::function<void(InstanceTable&)> replace_calls = nullptr;
};

/// A Vulkan instance. Thread-safe. Must outlive the devices made from it.
class Instance {
 public:
  /// Creates an instance of Vulkan 1.2. Errors: unsupported (no loader, driver or validation layer; the message says
  /// what to install); out_of_memory.
  static Result<std::unique_ptr<Instance>> create(const InstanceOptions& options = {});
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// Lists the physical devices in the loader's order, including unusable ones. Errors: same as create.
  Result<std::vector<VkPhysicalDevice>> devices() const;
  /// Returns the warnings and errors of the validation layer so far; empty without the layer.
  std::vector<std::string> messages() const { return log_->texts(); }

  VkInstance handle() const { return instance_; }
  const InstanceTable& calls() const { return calls_; }
  PFN_vkGetInstanceProcAddr resolver() const { return resolver_; }

 private:
  Instance() = default;
  static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                  VkDebugUtilsMessageTypeFlagsEXT,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);
  Result<void> open(const InstanceOptions& options);

  PFN_vkGetInstanceProcAddr resolver_ = nullptr;
  InstanceTable calls_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::shared_ptr<MessageLog> log_;
};

}  // namespace sgm::vulkan
