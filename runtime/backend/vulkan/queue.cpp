#include "backend/vulkan/queue.h"

namespace sgm::vulkan {

Result<std::unique_ptr<Queue>> Queue::create(Device& device) {
  std::unique_ptr<Queue> queue(new Queue(device));
  VkSemaphoreTypeCreateInfo type{};
  type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  info.pNext = &type;
  const VkResult result = device.calls().vkCreateSemaphore(device.handle(), &info, nullptr, &queue->semaphore_);
  if (result != VK_SUCCESS) return errorOf(result, "creating a timeline semaphore");
  return queue;
}

Queue::~Queue() {
  drain();
  device_.calls().vkDestroySemaphore(device_.handle(), semaphore_, nullptr);
}

Error Queue::failed(VkResult result, const char* what) const {
  if (result == VK_ERROR_DEVICE_LOST) lost_.store(true);
  return errorOf(result, what + device_.info().name);
}

Result<uint64_t> Queue::submit(VkCommandBuffer commands) {
  const QueueLock lock(device_);
  if (lost()) return failed(VK_ERROR_DEVICE_LOST, "submitting to ");
  const uint64_t value = submitted_.load() + 1;
  VkTimelineSemaphoreSubmitInfo timeline{};
  timeline.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO;
  timeline.signalSemaphoreValueCount = 1;
  timeline.pSignalSemaphoreValues = &value;
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.pNext = &timeline;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands;
  info.signalSemaphoreCount = 1;
  info.pSignalSemaphores = &semaphore_;
  const VkResult result = device_.calls().vkQueueSubmit(device_.queue(), 1, &info, VK_NULL_HANDLE);
  if (result != VK_SUCCESS) return failed(result, "submitting to ");
  submitted_.store(value);
  return value;
}

Result<bool> Queue::wait(uint64_t value, uint64_t nanoseconds) const {
  if (value > submitted()) return Error{Code::invalid_argument, "the work to wait for was not submitted"};
  if (lost()) return failed(VK_ERROR_DEVICE_LOST, "waiting for ");
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = 1;
  info.pSemaphores = &semaphore_;
  info.pValues = &value;
  const VkResult result = device_.calls().vkWaitSemaphores(device_.handle(), &info, nanoseconds);
  if (result == VK_TIMEOUT) return false;
  if (result != VK_SUCCESS) return failed(result, "waiting for ");
  return true;
}

Result<uint64_t> Queue::reached() const {
  if (lost()) return failed(VK_ERROR_DEVICE_LOST, "querying ");
  uint64_t value = 0;
  const VkResult result = device_.calls().vkGetSemaphoreCounterValue(device_.handle(), semaphore_, &value);
  if (result != VK_SUCCESS) return failed(result, "querying ");
  return value;
}

void Queue::drain() const {
  const uint64_t last = submitted();
  if (last == 0 || !semaphore_) return;
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = 1;
  info.pSemaphores = &semaphore_;
  info.pValues = &last;
  // Calls vkWaitSemaphores directly, since wait() returns at once if the device is lost. Tries twice, because the first
  // call may fail if the driver is out of memory.
  const auto ended = [&] {
    return device_.calls().vkWaitSemaphores(device_.handle(), &info, UINT64_MAX) == VK_SUCCESS;
  };
  if (!ended()) ended();
}

}  // namespace sgm::vulkan
