#include "backend/vulkan/memory.h"

#include <algorithm>
#include <new>
#include <utility>

namespace sgm::vulkan {
namespace {

constexpr uint64_t kGranule = 256;  // alignment of buffers in bytes; no device requires more for storage buffers

constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                      VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT;

constexpr VkExternalMemoryHandleTypeFlagBits kHandleType = VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT;

constexpr VkMemoryPropertyFlags kNear = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kVisible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
constexpr VkMemoryPropertyFlags kCoherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

// Returns how suitable a memory type is for this kind; -1 if it is not usable.
int scoreOf(VkMemoryPropertyFlags flags, MemoryKind kind, bool unified) {
  // Protected, lazily allocated and vendor-specific memory has special rules, so it is not used.
  if (flags & ~(kNear | kVisible | kCoherent | kCached)) return -1;
  const auto has = [&](VkMemoryPropertyFlags bits) { return (flags & bits) == bits ? 1 : 0; };
  // If host and device have separate memory, upload and readback buffers avoid the part of device memory that the host
  // can see: that part is small, and other programs need it.
  const int fits = has(kNear) == (unified ? 1 : 0) ? 1 : 0;
  switch (kind) {
    case MemoryKind::device:
      if (!has(kNear)) return -1;
      return has(kVisible | kCoherent) == (unified ? 1 : 0) ? 1 : 0;
    case MemoryKind::upload:
      if (!has(kVisible | kCoherent)) return -1;
      return 2 * fits + (has(kCached) ? 0 : 1);
    case MemoryKind::readback:
      if (!has(kVisible)) return -1;
      return 4 * has(kCached) + 2 * has(kCoherent) + fits;
  }
  return -1;
}

}  // namespace

int chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed, MemoryKind kind, bool unified) {
  int best = -1, best_score = -1;
  for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
    if (!(allowed >> type & 1)) continue;
    const int score = scoreOf(memory.memoryTypes[type].propertyFlags, kind, unified);
    if (score > best_score) best_score = score, best = static_cast<int>(type);
  }
  return best;
}

std::optional<SharedMemoryNeeds> sharedMemoryNeeds(const Device& device) {
  if (!device.externalMemory()) return std::nullopt;
  VkPhysicalDeviceExternalBufferInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_BUFFER_INFO;
  info.usage = kUsage;
  info.handleType = kHandleType;
  VkExternalBufferProperties properties{};
  properties.sType = VK_STRUCTURE_TYPE_EXTERNAL_BUFFER_PROPERTIES;
  device.instanceCalls().vkGetPhysicalDeviceExternalBufferProperties(device.physical(), &info, &properties);
  const VkExternalMemoryFeatureFlags features = properties.externalMemoryProperties.externalMemoryFeatures;
  if (!(features & VK_EXTERNAL_MEMORY_FEATURE_EXPORTABLE_BIT)) return std::nullopt;
  return SharedMemoryNeeds{(features & VK_EXTERNAL_MEMORY_FEATURE_DEDICATED_ONLY_BIT) != 0};
}

namespace {

class ExportedBlock final : public SharedBlock {
 public:
  ExportedBlock(const Device& device, uint64_t bytes, bool dedicated)
      : device_(device), bytes_(bytes), dedicated_(dedicated) {}
  void setMemory(VkDeviceMemory memory) { memory_ = memory; }
  uint64_t bytes() const override { return bytes_; }
  bool dedicated() const override { return dedicated_; }
  Result<int> descriptor() const override {
    VkMemoryGetFdInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_GET_FD_INFO_KHR;
    info.memory = memory_;
    info.handleType = kHandleType;
    int descriptor = -1;
    const VkResult result = device_.calls().vkGetMemoryFdKHR(device_.handle(), &info, &descriptor);
    if (result != VK_SUCCESS) return errorOf(result, "sharing memory of " + device_.info().name);
    return descriptor;
  }

 private:
  const Device& device_;
  const uint64_t bytes_;
  const bool dedicated_;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
};

}  // namespace

struct Memory::Block {
  Ranges ranges;
  MemoryKind kind;
  bool whole;  // true if the block was allocated for a single large buffer
  uint64_t size = 0;
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  std::byte* data = nullptr;
  bool coherent = true;
  std::unique_ptr<SharedBlock> shared = nullptr;
};

Memory::Memory(Device& device, const MemoryOptions& options)
    : device_(device),
      options_(options),
      granule_(
          std::max({kGranule, device.limits().nonCoherentAtomSize, device.limits().minStorageBufferOffsetAlignment})),
      unified_(!options.apart &&
               (device.info().software() || device.info().type == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU)) {
  device.instanceCalls().vkGetPhysicalDeviceMemoryProperties(device.physical(), &properties_);
}

Memory::~Memory() {
  for (auto& blocks : blocks_) {
    for (auto& block : blocks) destroy(*block);
  }
}

Result<Buffer> Memory::buffer(MemoryKind kind, VkDeviceSize bytes) {
  if (bytes == 0) return Error{Code::invalid_argument, "a GPU buffer must have at least one byte"};
  if (bytes > UINT64_MAX / 4)
    return errorOf(VK_ERROR_OUT_OF_DEVICE_MEMORY, "allocating a GPU buffer of more than 2^62 bytes");
  const std::scoped_lock lock(mutex_);
  auto& blocks = blocks_[static_cast<size_t>(kind)];
  uint64_t shared = 0;
  for (auto& block : blocks) {
    if (block->whole) continue;
    ++shared;
    if (const auto offset = block->ranges.take(bytes)) return take(*block, *offset, bytes);
  }
  const uint64_t needed = (bytes + granule_ - 1) / granule_ * granule_;
  const uint64_t usual =
      std::min(options_.first_block << std::min<uint64_t>(shared, 16), options_.largest_block) / granule_ * granule_;
  const bool whole = needed > usual;
  // If the device has no memory for a large block, a smaller one may still fit.
  for (uint64_t size = std::max(needed, usual);; size = std::max(needed, size / 2 / granule_ * granule_)) {
    auto block = addBlock(kind, size, whole);
    if (block) return take(**block, *(*block)->ranges.take(bytes), bytes);
    const bool scarce = block.error().code == Code::out_of_memory || block.error().code == Code::limit;
    if (!scarce || (size == needed && !dropEmptyBlocks())) return block.error();
  }
}

Buffer Memory::take(Block& block, uint64_t offset, VkDeviceSize bytes) {
  Buffer buffer;
  buffer.memory_ = this;
  buffer.block_ = &block;
  buffer.handle_ = block.buffer;
  buffer.offset_ = offset;
  buffer.size_ = bytes;
  buffer.data_ = block.data ? block.data + offset : nullptr;
  statistics_.used += bytes;
  ++statistics_.buffers;
  return buffer;
}

Result<Memory::Block*> Memory::addBlock(MemoryKind kind, VkDeviceSize bytes, bool whole) {
  if (bytes > options_.cap || statistics_.reserved > options_.cap - bytes) {
    return Error{Code::limit, "a GPU buffer would exceed the " + std::to_string(options_.cap) +
                                  " bytes of GPU memory that are allowed"};
  }
  auto& blocks = blocks_[static_cast<size_t>(kind)];
  blocks.reserve(blocks.size() + 1);
  auto block = std::make_unique<Block>(Block{Ranges(bytes, granule_), kind, whole});
  try {
    if (auto filled = fill(*block, kind, bytes); !filled) {
      destroy(*block);
      return filled.error();
    }
  } catch (const std::bad_alloc&) {
    destroy(*block);
    throw;
  }
  block->size = bytes;
  statistics_.reserved += bytes;
  ++statistics_.blocks;
  return blocks.emplace_back(std::move(block)).get();
}

Result<void> Memory::fill(Block& block, MemoryKind kind, VkDeviceSize bytes) {
  const std::string what = "allocating " + std::to_string(bytes) + " bytes of GPU memory";
  const DeviceTable& calls = device_.calls();
  if (bytes > device_.info().max_allocation) return errorOf(VK_ERROR_OUT_OF_DEVICE_MEMORY, what);
  VkExternalMemoryBufferCreateInfo exported_buffer{};
  exported_buffer.sType = VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO;
  exported_buffer.handleTypes = kHandleType;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  if (options_.shared) info.pNext = &exported_buffer;
  info.size = bytes;
  info.usage = kUsage;
  std::vector<uint32_t> families = options_.families;
  families.push_back(device_.family());
  std::sort(families.begin(), families.end());
  families.erase(std::unique(families.begin(), families.end()), families.end());
  if (families.size() > 1) {
    info.sharingMode = VK_SHARING_MODE_CONCURRENT;
    info.queueFamilyIndexCount = static_cast<uint32_t>(families.size());
    info.pQueueFamilyIndices = families.data();
  }
  VkResult result = calls.vkCreateBuffer(device_.handle(), &info, nullptr, &block.buffer);
  if (result != VK_SUCCESS) return errorOf(result, what);
  VkMemoryRequirements needs;
  calls.vkGetBufferMemoryRequirements(device_.handle(), block.buffer, &needs);
  const int type = chooseMemoryType(properties_, needs.memoryTypeBits, kind, unified_);
  if (type < 0) return Error{Code::unsupported, what + ": " + device_.info().name + " has no memory of this kind"};
  const auto index = static_cast<uint32_t>(type);
  if (auto checked = checkBudget(index, needs.size); !checked) return checked.error();
  VkMemoryDedicatedAllocateInfo dedicated{};
  dedicated.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
  dedicated.buffer = block.buffer;
  VkExportMemoryAllocateInfo exported{};
  exported.sType = VK_STRUCTURE_TYPE_EXPORT_MEMORY_ALLOCATE_INFO;
  exported.handleTypes = kHandleType;
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  std::unique_ptr<ExportedBlock> shared_block;
  if (options_.shared) {
    const std::optional<SharedMemoryNeeds> shared = sharedMemoryNeeds(device_);
    if (!shared)
      return Error{Code::unsupported, what + ": " + device_.info().name + " cannot share it with other APIs"};
    if (shared->dedicated) exported.pNext = &dedicated;
    allocate.pNext = &exported;
    shared_block = std::make_unique<ExportedBlock>(device_, needs.size, shared->dedicated);
  }
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex = index;
  result = calls.vkAllocateMemory(device_.handle(), &allocate, nullptr, &block.memory);
  if (result != VK_SUCCESS) return errorOf(result, what);
  if (shared_block) shared_block->setMemory(block.memory);
  block.shared = std::move(shared_block);
  result = calls.vkBindBufferMemory(device_.handle(), block.buffer, block.memory, 0);
  const VkMemoryPropertyFlags flags = properties_.memoryTypes[index].propertyFlags;
  block.coherent = (flags & kCoherent) != 0;
  if (result == VK_SUCCESS && (kind != MemoryKind::device || (unified_ && (flags & kVisible) && block.coherent))) {
    void* data = nullptr;
    result = calls.vkMapMemory(device_.handle(), block.memory, 0, VK_WHOLE_SIZE, 0, &data);
    block.data = static_cast<std::byte*>(data);
  }
  if (result != VK_SUCCESS) return errorOf(result, what);
  return {};
}

Result<void> Memory::checkBudget(uint32_t type, VkDeviceSize bytes) const {
  if (!device_.memoryBudget()) return {};
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{};
  budget.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT;
  VkPhysicalDeviceMemoryProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2;
  properties.pNext = &budget;
  device_.instanceCalls().vkGetPhysicalDeviceMemoryProperties2(device_.physical(), &properties);
  const uint32_t heap = properties_.memoryTypes[type].heapIndex;
  const uint64_t used = std::min(budget.heapUsage[heap], budget.heapBudget[heap]);
  if (bytes <= budget.heapBudget[heap] - used) return {};
  return Error{Code::out_of_memory, "allocating " + std::to_string(bytes) + " bytes of GPU memory: of the " +
                                        std::to_string(budget.heapBudget[heap]) + " bytes that the driver allows, " +
                                        std::to_string(used) + " are in use"};
}

void Memory::destroy(Block& block) noexcept {
  const DeviceTable& calls = device_.calls();
  block.shared.reset();
  calls.vkDestroyBuffer(device_.handle(), block.buffer, nullptr);
  calls.vkFreeMemory(device_.handle(), block.memory, nullptr);
}

void Memory::give(Buffer& buffer) noexcept {
  // destroyed after the mutex is released, because destroying a block that another API has imported may take long
  std::unique_ptr<Block> dead;
  {
    const std::scoped_lock lock(mutex_);
    dead = giveRange(buffer);
  }
  if (dead) destroy(*dead);
}

std::unique_ptr<Memory::Block> Memory::giveRange(const Buffer& buffer) noexcept {
  auto& block = *static_cast<Block*>(buffer.block_);
  block.ranges.give(buffer.offset_);
  statistics_.used -= buffer.size_;
  --statistics_.buffers;
  if (!block.ranges.empty()) return nullptr;
  // One empty block of each kind is kept for the next buffer.
  auto& blocks = blocks_[static_cast<size_t>(block.kind)];
  const auto spare = [&](const auto& other) { return other.get() != &block && !other->whole && other->ranges.empty(); };
  if (!block.whole && std::none_of(blocks.begin(), blocks.end(), spare)) return nullptr;
  statistics_.reserved -= block.size;
  --statistics_.blocks;
  const auto at = std::find_if(blocks.begin(), blocks.end(), [&](const auto& other) { return other.get() == &block; });
  std::unique_ptr<Block> dead = std::move(*at);
  blocks.erase(at);
  return dead;
}

MemoryStatistics Memory::statistics() const {
  const std::scoped_lock lock(mutex_);
  return statistics_;
}

bool Memory::dropEmptyBlocks() noexcept {
  const uint32_t before = statistics_.blocks;
  for (auto& blocks : blocks_) {
    std::erase_if(blocks, [&](const auto& block) {
      if (!block->ranges.empty()) return false;
      statistics_.reserved -= block->size;
      --statistics_.blocks;
      destroy(*block);
      return true;
    });
  }
  return statistics_.blocks < before;
}

Result<void> Memory::beforeRead(const Buffer& buffer) const {
  const auto& block = *static_cast<const Block*>(buffer.block_);
  if (block.coherent || !block.data) return {};
  VkMappedMemoryRange range{};
  range.sType = VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE;
  range.memory = block.memory;
  range.offset = buffer.offset_;
  range.size = (buffer.size_ + granule_ - 1) / granule_ * granule_;
  const VkResult result = device_.calls().vkInvalidateMappedMemoryRanges(device_.handle(), 1, &range);
  if (result != VK_SUCCESS) return errorOf(result, "reading back from " + device_.info().name);
  return {};
}

Buffer::~Buffer() {
  if (memory_) memory_->give(*this);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  if (this == &other) return *this;
  if (memory_) memory_->give(*this);
  memory_ = std::exchange(other.memory_, nullptr);
  block_ = std::exchange(other.block_, nullptr);
  handle_ = std::exchange(other.handle_, VK_NULL_HANDLE);
  offset_ = std::exchange(other.offset_, 0);
  size_ = std::exchange(other.size_, 0);
  data_ = std::exchange(other.data_, nullptr);
  return *this;
}

SharedBlock* Buffer::block() const { return block_ ? static_cast<Memory::Block*>(block_)->shared.get() : nullptr; }

Result<void> Buffer::beforeRead() const {
  if (!memory_) return {};
  return memory_->beforeRead(*this);
}

}  // namespace sgm::vulkan
