#include "backend/vulkan/commands.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace sgm::vulkan {
namespace {

struct Scope {
  VkPipelineStageFlags stages = 0;
  VkAccessFlags reads = 0, writes = 0;
};

Scope scopeOf(uint32_t uses) {
  Scope scope;
  const auto add = [&](uint32_t use, VkPipelineStageFlags stage, VkAccessFlags reads, VkAccessFlags writes) {
    if (!(uses & use)) return;
    scope.stages |= stage;
    scope.reads |= reads;
    scope.writes |= writes;
  };
  add(kCompute, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT, VK_ACCESS_SHADER_WRITE_BIT);
  add(kIndirect, VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, VK_ACCESS_INDIRECT_COMMAND_READ_BIT, 0);
  add(kTransfer, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT, VK_ACCESS_TRANSFER_WRITE_BIT);
  add(kHost, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT, 0);
  return scope;
}

}  // namespace

struct Commands::Slot {
  enum State { idle, recording, submitted };
  State state = idle;
  uint64_t value = 0;  // value of the queue's timeline semaphore once these commands have ended; set at their
                       // submission
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkDescriptorPool sets = VK_NULL_HANDLE;
};

Commands::Commands(Commands&& other) noexcept : ring_(other.ring_), slot_(std::exchange(other.slot_, nullptr)) {}

Commands::~Commands() {
  if (!slot_) return;
  const std::scoped_lock lock(ring_->mutex_);
  slot_->state = Slot::idle;
  ring_->recorded_.notify_one();
}

VkCommandBuffer Commands::handle() const { return slot_->commands; }

Result<void> Commands::bind(const Pipeline& pipeline, std::span<const BufferRange> buffers,
                            std::span<const std::byte> push) {
  if (buffers.size() != pipeline.buffers() || push.size() != pipeline.pushBytes()) {
    return Error{Code::invalid_argument, "this shader was made for " + std::to_string(pipeline.buffers()) +
                                             " buffers and " + std::to_string(pipeline.pushBytes()) +
                                             " bytes of push constants"};
  }
  const Device& device = ring_->queue_.device();
  const DeviceTable& calls = device.calls();
  const VkCommandBuffer commands = slot_->commands;
  if (!buffers.empty()) {
    const VkDescriptorSetLayout layout = pipeline.setLayout();
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = slot_->sets;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    const VkResult result = calls.vkAllocateDescriptorSets(device.handle(), &info, &set);
    if (result != VK_SUCCESS) return errorOf(result, "binding a shader's buffers");
    std::array<VkDescriptorBufferInfo, kMaxBuffers> ranges{};
    std::array<VkWriteDescriptorSet, kMaxBuffers> writes{};
    for (uint32_t i = 0; i < buffers.size(); ++i) {
      ranges[i] = {buffers[i].handle, buffers[i].offset, buffers[i].size};
      writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
      writes[i].dstSet = set;
      writes[i].dstBinding = i;
      writes[i].descriptorCount = 1;
      writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
      writes[i].pBufferInfo = &ranges[i];
    }
    calls.vkUpdateDescriptorSets(device.handle(), pipeline.buffers(), writes.data(), 0, nullptr);
    calls.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout(), 0, 1, &set, 0, nullptr);
  }
  calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle());
  if (!push.empty()) {
    calls.vkCmdPushConstants(commands, pipeline.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, pipeline.pushBytes(),
                             push.data());
  }
  return {};
}

void Commands::dispatch(uint32_t x, uint32_t y, uint32_t z) {
  ring_->queue_.device().calls().vkCmdDispatch(slot_->commands, x, y, z);
}

void Commands::dispatchIndirect(const BufferRange& counts) {
  ring_->queue_.device().calls().vkCmdDispatchIndirect(slot_->commands, counts.handle, counts.offset);
}

void Commands::fill(const BufferRange& range, uint32_t word) {
  ring_->queue_.device().calls().vkCmdFillBuffer(slot_->commands, range.handle, range.offset, range.size, word);
}

void Commands::copy(const BufferRange& from, const BufferRange& to) {
  const VkBufferCopy region{from.offset, to.offset, from.size};
  ring_->queue_.device().calls().vkCmdCopyBuffer(slot_->commands, from.handle, to.handle, 1, &region);
}

void Commands::write(const BufferRange& range, std::span<const std::byte> bytes) {
  ring_->queue_.device().calls().vkCmdUpdateBuffer(slot_->commands, range.handle, range.offset, range.size,
                                                   bytes.data());
}

void Commands::barrier(uint32_t before, uint32_t after) {
  const Scope source = scopeOf(before), destination = scopeOf(after);
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = source.writes;
  barrier.dstAccessMask = destination.reads | destination.writes;
  ring_->queue_.device().calls().vkCmdPipelineBarrier(slot_->commands, source.stages, destination.stages, 0, 1,
                                                      &barrier, 0, nullptr, 0, nullptr);
}

void Commands::acquire(std::span<const BufferRange> ranges) {
  const Device& device = ring_->queue_.device();
  std::vector<VkBufferMemoryBarrier> barriers;
  barriers.reserve(ranges.size());
  for (const BufferRange& range : ranges) {
    VkBufferMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_EXTERNAL;
    // Buffers that several queue families share have no owner, so their ownership is not transferred.
    barrier.dstQueueFamilyIndex = device.sharesBuffers() ? VK_QUEUE_FAMILY_IGNORED : device.family();
    barrier.buffer = range.handle;
    barrier.offset = range.offset;
    barrier.size = range.size;
    barriers.push_back(barrier);
  }
  device.calls().vkCmdPipelineBarrier(slot_->commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                      VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr,
                                      static_cast<uint32_t>(barriers.size()), barriers.data(), 0, nullptr);
}

CommandRing::CommandRing(Queue& queue) : queue_(queue) {}

Result<std::unique_ptr<CommandRing>> CommandRing::create(Queue& queue, const CommandRingOptions& options) {
  std::unique_ptr<CommandRing> ring(new CommandRing(queue));
  ring->slots_.resize(options.recordings);
  for (Commands::Slot& slot : ring->slots_) {
    if (auto filled = ring->fill(slot, options); !filled) return filled.error();
  }
  return ring;
}

Result<void> CommandRing::fill(Commands::Slot& slot, const CommandRingOptions& options) {
  const Device& device = queue_.device();
  const DeviceTable& calls = device.calls();
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  pool.queueFamilyIndex = device.family();
  VkResult result = calls.vkCreateCommandPool(device.handle(), &pool, nullptr, &slot.pool);
  if (result == VK_SUCCESS) {
    VkCommandBufferAllocateInfo commands{};
    commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    commands.commandPool = slot.pool;
    commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands.commandBufferCount = 1;
    result = calls.vkAllocateCommandBuffers(device.handle(), &commands, &slot.commands);
  }
  if (result == VK_SUCCESS) {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, options.binds * options.buffers_of_a_bind};
    VkDescriptorPoolCreateInfo sets{};
    sets.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    sets.maxSets = options.binds;
    sets.poolSizeCount = 1;
    sets.pPoolSizes = &size;
    result = calls.vkCreateDescriptorPool(device.handle(), &sets, nullptr, &slot.sets);
  }
  if (result != VK_SUCCESS) return errorOf(result, "creating command buffers");
  return {};
}

CommandRing::~CommandRing() {
  queue_.drain();
  const Device& device = queue_.device();
  for (Commands::Slot& slot : slots_) {
    device.calls().vkDestroyDescriptorPool(device.handle(), slot.sets, nullptr);
    device.calls().vkDestroyCommandPool(device.handle(), slot.pool, nullptr);
  }
}

Result<Commands::Slot*> CommandRing::findSlot(uint64_t nanoseconds) {
  for (;;) {
    const auto reached = queue_.reached();
    if (!reached) return reached.error();
    uint64_t oldest = UINT64_MAX;
    {
      const std::scoped_lock lock(mutex_);
      for (Commands::Slot& slot : slots_) {
        if (slot.state == Commands::Slot::submitted && slot.value <= *reached) slot.state = Commands::Slot::idle;
        if (slot.state == Commands::Slot::submitted) oldest = std::min(oldest, slot.value);
        if (slot.state != Commands::Slot::idle) continue;
        slot.state = Commands::Slot::recording;
        return &slot;
      }
    }
    if (oldest == UINT64_MAX) {
      if (!awaitRecorded(nanoseconds)) return Error{Code::limit, "too many command buffers in flight"};
      continue;
    }
    // The slots are searched again after the wait: another thread may have taken this slot meanwhile.
    const auto ended = queue_.wait(oldest, nanoseconds);
    if (!ended) return ended.error();
    if (!*ended) return Error{Code::limit, "the GPU has not finished its earlier work in time"};
  }
}

bool CommandRing::awaitRecorded(uint64_t nanoseconds) {
  const auto recorded = [this] {
    return std::any_of(slots_.begin(), slots_.end(),
                       [](const Commands::Slot& slot) { return slot.state != Commands::Slot::recording; });
  };
  std::unique_lock lock(mutex_);
  if (nanoseconds == UINT64_MAX) {
    recorded_.wait(lock, recorded);
    return true;
  }
  return recorded_.wait_for(lock, std::chrono::nanoseconds(nanoseconds), recorded);
}

Result<Commands> CommandRing::begin(uint64_t nanoseconds) {
  const auto slot = findSlot(nanoseconds);
  if (!slot) return slot.error();
  Commands commands(*this, **slot);
  const Device& device = queue_.device();
  const DeviceTable& calls = device.calls();
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  VkResult result = calls.vkResetCommandPool(device.handle(), (*slot)->pool, 0);
  if (result == VK_SUCCESS) result = calls.vkResetDescriptorPool(device.handle(), (*slot)->sets, 0);
  if (result == VK_SUCCESS) result = calls.vkBeginCommandBuffer((*slot)->commands, &info);
  if (result != VK_SUCCESS) return errorOf(result, "starting to record commands for " + device.info().name);
  return commands;
}

Result<uint64_t> CommandRing::submit(Commands commands) {
  const Device& device = queue_.device();
  const VkResult result = device.calls().vkEndCommandBuffer(commands.handle());
  if (result != VK_SUCCESS) return errorOf(result, "recording commands for " + device.info().name);
  const auto value = queue_.submit(commands.handle());
  if (!value) return value.error();
  const std::scoped_lock lock(mutex_);
  commands.slot_->state = Commands::Slot::submitted;
  commands.slot_->value = *value;
  commands.slot_ = nullptr;
  recorded_.notify_one();
  return *value;
}

}  // namespace sgm::vulkan
