#pragma once
// Wrappers of Vulkan's calls and handles: results are checked, and handles are destroyed automatically.

#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>
#include <utility>

/// This machine has no device that this program can use.
struct NoDevice : std::runtime_error {
  using runtime_error::runtime_error;
};

/// Throws an exception if a call has failed. Every call that can fail passes its result to this function.
inline void must(VkResult result, const char* call) {
  if (result == VK_SUCCESS) return;
  throw std::runtime_error(std::string(call) + " failed: VkResult " + std::to_string(result));
}

/// Owner of a handle of a Vulkan device. The device must outlive the owner, and must have finished using the handle
/// when the owner is destroyed.
template <class Handle, auto Destroy>
class Owned {
 public:
  Owned() = default;
  Owned(VkDevice device, Handle handle) : device_(device), handle_(handle) {}
  Owned(Owned&& other) noexcept : device_(other.device_), handle_(std::exchange(other.handle_, Handle{})) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Owned() {
    if (handle_) Destroy(device_, handle_, nullptr);
  }
  Handle get() const { return handle_; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  Handle handle_{};
};

/// Calls `create` with `info`, and returns the owner of the new handle.
template <auto Destroy, class Handle, class Info>
Owned<Handle, Destroy> make(VkResult (*create)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*),
                            const char* call, VkDevice device, const Info& info) {
  Handle handle{};
  must(create(device, &info, nullptr, &handle), call);
  return {device, handle};
}

/// Calls make() for the Vulkan object with this name.
#define MAKE_VULKAN(name, device, info) make<vkDestroy##name>(vkCreate##name, "vkCreate" #name, device, info)
