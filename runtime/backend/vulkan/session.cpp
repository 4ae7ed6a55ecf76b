#include "backend/vulkan/session.h"

namespace sgm::vulkan {

Result<std::shared_ptr<Session>> Session::open(const VulkanBackendOptions& options) {
  std::shared_ptr<Session> session(new Session);
  Result<std::unique_ptr<Device>> device = options.open();
  if (!device) return device.error();
  session->device = std::move(*device);
  auto queue = Queue::create(*session->device);
  if (!queue) return queue.error();
  session->queue = std::move(*queue);
  session->memory = std::make_unique<Memory>(*session->device, options.memory);
  auto ring = CommandRing::create(*session->queue);
  if (!ring) return ring.error();
  session->ring = std::move(*ring);
  if (!options.pipeline_folder.empty()) {
    // Without it pipelines are made anew, and nothing else.
    if (auto cache = PipelineCache::create(*session->device, options.pipeline_folder)) {
      session->cache = std::move(*cache);
    } else if (options.warn) {
      options.warn("compiled pipelines are not kept: " + cache.error().message);
    }
  }
  auto mesher = Mesher::create(*session->queue, *session->memory, *session->ring, session->cache.get());
  if (!mesher) return mesher.error();
  session->mesher = std::move(*mesher);
  if (session->device->borrowed()) {
    MemoryOptions memory = options.memory;
    memory.cap = options.resident_cap;
    memory.families = session->device->readers();
    session->kept_memory = std::make_unique<Memory>(*session->device, memory);
    session->kept =
        std::make_unique<DeviceMeshes>(*session->queue, *session->kept_memory, *session->memory, *session->ring);
  }
  return session;
}

Session::~Session() {
  if (queue) queue->drain();
  idle_.clear();
  stuck_.clear();
}

std::unique_ptr<Slot> Session::takeSlot(std::pmr::memory_resource* of_plan) {
  const std::scoped_lock lock(mutex_);
  if (idle_.empty()) {
    auto made = std::make_unique<Slot>(of_plan);
    idle_.reserve(slots_ + 1);
    stuck_.reserve(slots_ + 1);
    ++slots_;
    return made;
  }
  // The one that has been idle for longest: nothing is copied out of it any more, as a rule.
  std::unique_ptr<Slot> slot = std::move(idle_.front());
  idle_.erase(idle_.begin());
  return slot;
}

void Session::release(std::unique_ptr<Slot>& slot) noexcept {
  slot->value = 0;
  const std::scoped_lock lock(mutex_);
  (slot->stuck ? stuck_ : idle_).push_back(std::move(slot));
}

Result<bool> Session::reach(uint64_t value) const {
  const Result<bool> reached = queue->wait(value);
  return reached ? reached : queue->wait(value);
}

}  // namespace sgm::vulkan
