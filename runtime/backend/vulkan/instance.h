#pragma once
// A Vulkan instance of our own, and what the validation layer says of its use.

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "backend/vulkan/loader.h"

namespace sgm::vulkan {

/// How closely VK_LAYER_KHRONOS_validation watches; each level includes those before it.
enum class Validation : uint8_t {
  none,
  core,             ///< the arguments and states of every call
  synchronization,  ///< missing barriers
  gpu_assisted,     ///< shaders that reach beyond their buffers; slow
};

/// Warnings and errors of the validation layer. Any thread.
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
  /// Gets the messages, those about what the instance's end leaves behind too; null: one of the instance's own.
  std::shared_ptr<MessageLog> log = nullptr;
  /// May replace entries of the table before anything but vkCreateInstance is called; for tests.
  std::function<void(InstanceTable&)> replace_calls = nullptr;
};

/// Any thread may use it. Must outlive the devices made from it.
class Instance {
 public:
  /// Of Vulkan 1.2. Errors: unsupported (no loader, no driver, no validation layer), with what to install;
  /// out_of_memory.
  static Result<std::unique_ptr<Instance>> create(const InstanceOptions& options = {});
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// In the loader's order, unusable ones too. Errors: as create.
  Result<std::vector<VkPhysicalDevice>> devices() const;
  /// Warnings and errors of the validation layer so far; empty without it.
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
