#pragma once
// Frames in flight: the host records a frame while the device still draws earlier ones.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <vector>

#include "draw_list.h"
#include "offscreen.h"
#include "picture.h"
#include "view_point.h"
#include "vulkan_device.h"

/// Draws frames, several of which may be in flight on the device. Frames are numbered from 1. Not thread-safe.
class Frames {
 public:
  /// count: maximum number of frames in flight. Device and pipeline must outlive this object.
  Frames(VulkanDevice& device, const ChunkPipeline& pipeline, size_t count) : device_(device), pipeline_(pipeline) {
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    info.pNext = &type;
    ended_ = MAKE_VULKAN(Semaphore, device.handle(), info);
    slots_.reserve(count);
    while (slots_.size() < count) slots_.emplace_back(device, pipeline);
  }
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;
  /// Waits until the device has drawn all frames, so that the objects which they use may be destroyed afterwards.
  ~Frames() { static_cast<void>(wait(submitted_)); }

  uint64_t submitted() const { return submitted_; }

  /// Number of the last frame that the device has completed.
  uint64_t ended() const {
    uint64_t value = 0;
    must(vkGetSemaphoreCounterValue(device_.handle(), ended_.get(), &value), "vkGetSemaphoreCounterValue");
    return value;
  }

  /// Submits a frame. Waits only if the maximum number of frames is in flight. The buffers of the list must live until
  /// the frame has completed.
  void draw(const DrawList& list, const Matrix& matrix) {
    Slot& slot = slotOf(submitted_ + 1);
    if (submitted_ + 1 > slots_.size()) await(submitted_ + 1 - slots_.size());
    slot.write(device_, list);
    record(slot, list, matrix);
    submit(slot, list);
  }

  /// Waits for the last frame, and returns its picture.
  Picture picture() {
    await(submitted_);
    return slotOf(submitted_).target.picture();
  }

 private:
  struct Slot {
    Slot(const VulkanDevice& device, const ChunkPipeline& pipeline) : target(device, pipeline) {
      VkCommandPoolCreateInfo info{};
      info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
      info.queueFamilyIndex = device.family();
      pool = MAKE_VULKAN(CommandPool, device.handle(), info);
      VkCommandBufferAllocateInfo allocate{};
      allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
      allocate.commandPool = pool.get();
      allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
      allocate.commandBufferCount = 1;
      must(vkAllocateCommandBuffers(device.handle(), &allocate, &commands), "vkAllocateCommandBuffers");
    }

    /// Writes the list's records, then its commands, into the slot's buffer.
    void write(const VulkanDevice& device, const DrawList& list) {
      commands_at = list.records.size() * sizeof(ChunkRecord);
      const VkDeviceSize bytes = commands_at + list.draws.size() * sizeof(VkDrawIndexedIndirectCommand);
      if (bytes > written.size()) {
        written =
            HostBuffer(device, 2 * bytes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
      }
      if (bytes == 0) return;
      std::memcpy(written.data(), list.records.data(), commands_at);
      std::byte* at = written.data() + commands_at;
      for (const Draw& draw : list.draws) {
        std::memcpy(at, &draw.command, sizeof draw.command);
        at += sizeof draw.command;
      }
    }

    Offscreen target;
    Owned<VkCommandPool, vkDestroyCommandPool> pool;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    HostBuffer written;
    VkDeviceSize commands_at = 0;
  };

  Slot& slotOf(uint64_t frame) { return slots_[frame % slots_.size()]; }

  VkResult wait(uint64_t frame) const {
    const VkSemaphore semaphore = ended_.get();
    VkSemaphoreWaitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    info.semaphoreCount = 1;
    info.pSemaphores = &semaphore;
    info.pValues = &frame;
    return vkWaitSemaphores(device_.handle(), &info, UINT64_MAX);
  }
  void await(uint64_t frame) const { must(wait(frame), "vkWaitSemaphores"); }

  void record(const Slot& slot, const DrawList& list, const Matrix& matrix) const {
    must(vkResetCommandPool(device_.handle(), slot.pool.get(), 0), "vkResetCommandPool");
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    must(vkBeginCommandBuffer(slot.commands, &begin), "vkBeginCommandBuffer");
    slot.target.begin(slot.commands, pipeline_);
    vkCmdPushConstants(slot.commands, pipeline_.layout(), VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof matrix, matrix.data());
    // One draw call draws all consecutive parts that lie in the same buffer.
    for (size_t first = 0, next = 0; first < list.draws.size(); first = next) {
      const VkBuffer buffer = list.draws[first].buffer;
      while (next < list.draws.size() && list.draws[next].buffer == buffer) ++next;
      const VkBuffer buffers[] = {buffer, slot.written.get()};
      const VkDeviceSize beginnings[] = {0, 0};
      vkCmdBindVertexBuffers(slot.commands, 0, 2, buffers, beginnings);
      vkCmdBindIndexBuffer(slot.commands, buffer, 0, VK_INDEX_TYPE_UINT32);
      constexpr uint32_t kStride = sizeof(VkDrawIndexedIndirectCommand);
      vkCmdDrawIndexedIndirect(slot.commands, slot.written.get(), slot.commands_at + first * kStride,
                               static_cast<uint32_t>(next - first), kStride);
    }
    slot.target.end(slot.commands);
    must(vkEndCommandBuffer(slot.commands), "vkEndCommandBuffer");
  }

  /// Submits the frame. The device, not the host, waits until the meshes are complete: the work that signals the
  /// semaphore's value is already in the queue.
  void submit(const Slot& slot, const DrawList& list) {
    const uint64_t frame = submitted_ + 1;
    const VkSemaphore ended = ended_.get();
    const VkPipelineStageFlags read = VK_PIPELINE_STAGE_VERTEX_INPUT_BIT;
    VkTimelineSemaphoreSubmitInfo values{};
    values.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO;
    values.signalSemaphoreValueCount = 1;
    values.pSignalSemaphoreValues = &frame;
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.pNext = &values;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &slot.commands;
    info.signalSemaphoreCount = 1;
    info.pSignalSemaphores = &ended;
    if (list.semaphore != VK_NULL_HANDLE) {
      values.waitSemaphoreValueCount = info.waitSemaphoreCount = 1;
      values.pWaitSemaphoreValues = &list.value;
      info.pWaitSemaphores = &list.semaphore;
      info.pWaitDstStageMask = &read;
    }
    device_.submit(info);
    submitted_ = frame;
  }

  VulkanDevice& device_;
  const ChunkPipeline& pipeline_;
  // a timeline semaphore; its value is the number of the last frame that the device has completed
  Owned<VkSemaphore, vkDestroySemaphore> ended_;
  std::vector<Slot> slots_;
  uint64_t submitted_ = 0;
};
