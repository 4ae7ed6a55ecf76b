#pragma once
// Device memory: buffers are ranges of a few large blocks.
//
// Drivers allow only some thousand allocations, and each is slow. A block is one allocation with one VkBuffer over all
// of it, so that taking a buffer is a list lookup.

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
  device,    ///< fastest for shaders; visible to the host if it is the host's memory
  upload,    ///< the host writes, sequentially, without reading
  readback,  ///< the host reads, from cached memory if available
};
inline constexpr size_t kMemoryKinds = 3;

/// The best of the memory types in `allowed` (a bit each), -1 if none is suitable. unified: host and device share their
/// memory, so that it is near to both. Pure.
int chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed, MemoryKind kind, bool unified);

struct MemoryOptions {
  uint64_t first_block = uint64_t{64} << 20;     ///< bytes; each further block of a kind is twice as large as the
                                                 ///< previous one
  uint64_t largest_block = uint64_t{512} << 20;  ///< larger buffers get their own block
  uint64_t cap = UINT64_MAX;                     ///< limit for all blocks together, bytes
  bool apart = false;   ///< treats host and device memory as separate even if they are unified: for tests of copies
  bool shared = false;  ///< another API imports the blocks; needs a device with externalMemory()
  std::vector<uint32_t> families;  ///< further families whose queues use the buffers
};

struct MemoryStatistics {
  uint64_t used = 0;      ///< bytes of living buffers
  uint64_t reserved = 0;  ///< bytes of all blocks
  uint32_t buffers = 0;
  uint32_t blocks = 0;
};

class Memory;

/// A range of a VkBuffer, usable as storage, for transfers and indirect commands, and as vertices and indices. Its
/// destructor frees the bytes, and must run after the last command that uses them. The Memory must outlive it.
class Buffer {
 public:
  Buffer() = default;
  Buffer(Buffer&& other) noexcept { *this = std::move(other); }
  Buffer& operator=(Buffer&& other) noexcept;
  ~Buffer();

  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }
  VkBuffer handle() const { return handle_; }
  VkDeviceSize offset() const { return offset_; }  ///< in handle(); a multiple of 256
  VkDeviceSize size() const { return size_; }      ///< as requested
  std::byte* data() const { return data_; }        ///< null if not visible to the host
  void forget() noexcept { memory_ = nullptr; }    ///< never frees: the bytes stay reserved until the memory's end
  SharedBlock* block() const;                      ///< its block, with MemoryOptions::shared; else null
  /// Call after the device wrote and before the host reads data(). A no-op for memory that is coherent for the host.
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

/// How another API can import blocks of the device's memory; nullopt if it cannot.
struct SharedMemoryNeeds {
  bool dedicated = false;  ///< one allocation for one buffer, imported as such
};
std::optional<SharedMemoryNeeds> sharedMemoryNeeds(const Device& device);

/// Thread-safe. The device must outlive it. The content of a new buffer is undefined.
class Memory {
 public:
  explicit Memory(Device& device, const MemoryOptions& options = {});
  /// Precondition: no buffer is left or in use.
  ~Memory();
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  /// Errors: out_of_memory (of the device, or of its budget if VK_EXT_memory_budget reports it), limit (the cap),
  /// invalid_argument (0 bytes). On error nothing has changed, and smaller buffers may still succeed. Throws
  /// std::bad_alloc.
  Result<Buffer> buffer(MemoryKind kind, VkDeviceSize bytes);

  MemoryStatistics statistics() const;

 private:
  friend class Buffer;
  struct Block;
  void give(Buffer& buffer) noexcept;
  /// Returns the block, to be destroyed, if it is no longer needed. Precondition: the mutex is held.
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
