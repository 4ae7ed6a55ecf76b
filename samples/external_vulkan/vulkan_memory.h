#pragma once
// The engine's own device memory: buffers that the host writes and reads, and images that are drawn into. A real engine
// would allocate them from a few large blocks; here each has an allocation of its own.

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>

#include "vulkan_call.h"
#include "vulkan_device.h"

using MemoryOwner = Owned<VkDeviceMemory, vkFreeMemory>;

inline MemoryOwner allocate(const VulkanDevice& device, const VkMemoryRequirements& needs,
                            VkMemoryPropertyFlags properties) {
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = device.memoryType(needs.memoryTypeBits, properties);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  must(vkAllocateMemory(device.handle(), &info, nullptr, &memory), "vkAllocateMemory");
  return {device.handle(), memory};
}

/// A buffer in host-visible memory, which stays mapped.
class HostBuffer {
 public:
  HostBuffer() = default;
  HostBuffer(const VulkanDevice& device, VkDeviceSize bytes, VkBufferUsageFlags usage) : bytes_(bytes) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes;
    info.usage = usage;
    buffer_ = MAKE_VULKAN(Buffer, device.handle(), info);
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.handle(), buffer_.get(), &needs);
    memory_ = allocate(device, needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    must(vkBindBufferMemory(device.handle(), buffer_.get(), memory_.get(), 0), "vkBindBufferMemory");
    void* mapped = nullptr;
    must(vkMapMemory(device.handle(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    data_ = static_cast<std::byte*>(mapped);
  }

  VkBuffer get() const { return buffer_.get(); }
  VkDeviceSize size() const { return bytes_; }
  std::byte* data() const { return data_; }

 private:
  MemoryOwner memory_;  // must outlive the buffer that is bound to it
  Owned<VkBuffer, vkDestroyBuffer> buffer_;
  VkDeviceSize bytes_ = 0;
  std::byte* data_ = nullptr;
};

/// An image in device memory, with one view of the whole image.
class DeviceImage {
 public:
  DeviceImage(const VulkanDevice& device, VkExtent2D size, VkFormat format, VkImageUsageFlags usage,
              VkImageAspectFlags aspect) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    image_ = MAKE_VULKAN(Image, device.handle(), info);
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device.handle(), image_.get(), &needs);
    memory_ = allocate(device, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    must(vkBindImageMemory(device.handle(), image_.get(), memory_.get(), 0), "vkBindImageMemory");
    VkImageViewCreateInfo whole{};
    whole.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    whole.image = image_.get();
    whole.viewType = VK_IMAGE_VIEW_TYPE_2D;
    whole.format = format;
    whole.subresourceRange = {aspect, 0, 1, 0, 1};
    view_ = MAKE_VULKAN(ImageView, device.handle(), whole);
  }

  VkImage get() const { return image_.get(); }
  VkImageView view() const { return view_.get(); }

 private:
  MemoryOwner memory_;
  Owned<VkImage, vkDestroyImage> image_;
  Owned<VkImageView, vkDestroyImageView> view_;
};
