#pragma once
// Vulkan's calls and handles as an engine wraps them: results that must be looked at, handles that end by themselves.

#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>
#include <utility>

/// No device here that this program can use.
struct NoDevice : std::runtime_error {
  using runtime_error::runtime_error;
};

/// Every call that can fail comes through here.
inline void must(VkResult result, const char* call) {
  if (result == VK_SUCCESS) return;
  throw std::runtime_error(std::string(call) + " failed: VkResult " + std::to_string(result));
}

/// A handle of a device's. The device must outlive it, and have done with it at its end.
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

/// What Create makes of its description.
template <auto Destroy, class Handle, class Info>
Owned<Handle, Destroy> make(VkResult (*create)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*),
                            const char* call, VkDevice device, const Info& info) {
  Handle handle{};
  must(create(device, &info, nullptr, &handle), call);
  return {device, handle};
}

/// make, by the name of what is made.
#define MAKE_VULKAN(name, device, info) make<vkDestroy##name>(vkCreate##name, "vkCreate" #name, device, info)
