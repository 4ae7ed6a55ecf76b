#pragma once
// The device's memory: buffers that are ranges of few large blocks.
//
// Drivers allow some thousand allocations in all, and each takes long; a block is one allocation and one VkBuffer over
// the whole of it, so that taking a buffer is a look at a list.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "backend/vulkan/device.h"
#include "backend/vulkan/ranges.h"
#include "base/shared_memory.h"

namespace sgm::vulkan {

enum class MemoryKind : uint8_t {
  device,    ///< the fastest for shaders; the host sees it where it is the host's own memory
  upload,    ///< the host writes, in order and without reading
  readback,  ///< the host reads, from its cache where there is such memory
};
inline constexpr size_t kMemoryKinds = 3;

/// The best of the memory types in `allowed` (a bit each), -1 where none will do. unified: host and device share their
/// memory, so that what is near to the one is near to the other. Pure.
int chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed, MemoryKind kind, bool unified);

struct MemoryOptions {
  uint64_t first_block = uint64_t{64} << 20;     ///< bytes; each further one of a kind is twice as large as the last
  uint64_t largest_block = uint64_t{512} << 20;  ///< what needs more has a block of its own
  uint64_t cap = UINT64_MAX;                     ///< bytes of all blocks together
  bool apart = false;   ///< takes host and device to share no memory, even where they do: to test what is copied then
  bool shared = false;  ///< another API imports the blocks; of a device with externalMemory()
  std::vector<uint32_t> families;  ///< beside the device's own: whose queues use the buffers, too
};

struct MemoryStatistics {
  uint64_t used = 0;      ///< bytes asked for and not given back
  uint64_t reserved = 0;  ///< bytes of all blocks
  uint32_t buffers = 0;
  uint32_t blocks = 0;
};

class Memory;

/// A range of a VkBuffer, for any use as storage, in transfers and of indirect commands, and as vertices and indices.
/// Gives its bytes back at its end, which must come after the last command that uses them. Outlived by its Memory.
class Buffer {
 public:
  Buffer() = default;
  Buffer(Buffer&& other) noexcept { *this = std::move(other); }
  Buffer& operator=(Buffer&& other) noexcept;
  ~Buffer();

  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }
  VkBuffer handle() const { return handle_; }
  VkDeviceSize offset() const { return offset_; }  ///< in handle(); a multiple of 256
  VkDeviceSize size() const { return size_; }      ///< as asked for
  std::byte* data() const { return data_; }        ///< null where the host does not see it
  void forget() noexcept { memory_ = nullptr; }    ///< gives nothing back: its bytes are nobody's to the memory's end
  SharedBlock* block() const;                      ///< what it lies in, where MemoryOptions::shared; null: it is not
  /// After the device wrote and before the host reads data(). Nothing to do for memory that the host sees coherently.
  /// Error: out_of_memory.
  Result<void> beforeRead() const;

 private:
  friend class Memory;
  Memory* memory_ = nullptr;
  void* block_ = nullptr;
  VkBuffer handle_ = VK_NULL_HANDLE;
  VkDeviceSize offset_ = 0, size_ = 0;
  std::byte* data_ = nullptr;
};

/// Whether another API can import blocks of the device's memory, and how; nothing where not.
struct SharedMemoryNeeds {
  bool dedicated = false;  ///< of one buffer alone, and imported as such
};
std::optional<SharedMemoryNeeds> sharedMemoryNeeds(const Device& device);

/// Any thread may use it. Outlived by its device. The content of a new buffer is undefined.
class Memory {
 public:
  explicit Memory(Device& device, const MemoryOptions& options = {});
  /// All buffers have gone, and nothing uses them.
  ~Memory();
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  /// Errors: out_of_memory (the device's, or its budget where VK_EXT_memory_budget tells it), limit (the cap),
  /// invalid_argument (no bytes). Nothing has changed then, and smaller buffers may still be had. Throws
  /// std::bad_alloc.
  Result<Buffer> buffer(MemoryKind kind, VkDeviceSize bytes);

  MemoryStatistics statistics() const;

 private:
  friend class Buffer;
  struct Block;
  void give(Buffer& buffer) noexcept;
  /// The block, where it is not needed any more: to be destroyed. Precondition: the mutex is held.
  std::unique_ptr<Block> giveRange(const Buffer& buffer) noexcept;
  Result<Block*> addBlock(MemoryKind kind, VkDeviceSize bytes, bool whole);
  Result<void> fill(Block& block, MemoryKind kind, VkDeviceSize bytes);
  Result<void> checkBudget(uint32_t type, VkDeviceSize bytes) const;
  void destroy(Block& block) noexcept;
  Buffer take(Block& block, uint64_t offset, VkDeviceSize bytes);
  bool dropEmptyBlocks() noexcept;
  Result<void> beforeRead(const Buffer& buffer) const;

  Device& device_;
  MemoryOptions options_;
  VkPhysicalDeviceMemoryProperties properties_;
  uint64_t granule_;
  bool unified_;
  mutable std::mutex mutex_;
  std::array<std::vector<std::unique_ptr<Block>>, kMemoryKinds> blocks_;
  MemoryStatistics statistics_;
};

}  // namespace sgm::vulkan
