#pragma once
// Allocates device memory: buffers are ranges of a few large blocks.
//
// Drivers allow only some thousand allocations, and each is slow. So a block is one allocation with one VkBuffer over
// all of it, and taking a buffer from it is a list lookup.

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
  device,    ///< fastest for shaders; the host can see it only if host and device share memory
  upload,    ///< written by the host sequentially, never read by it
  readback,  ///< read by the host; cached memory if available
};
inline constexpr size_t kMemoryKinds = 3;

/// Returns the index of the best memory type among those in `allowed` (one bit each); -1 if none is suitable. unified:
/// host and device share their memory, so it is fast for both. Pure.
int chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed, MemoryKind kind, bool unified);

struct MemoryOptions {
  /// bytes of the first block of each kind; each further block is twice as large as the previous one
  uint64_t first_block = uint64_t{64} << 20;
  uint64_t largest_block = uint64_t{512} << 20;  ///< bytes; a larger buffer gets a block of its own
  uint64_t cap = UINT64_MAX;                     ///< limit for the total size of all blocks, in bytes
  bool apart = false;   ///< for tests of copies: treats host and device memory as separate even if they are unified
  bool shared = false;  ///< true: another API imports the blocks; needs a device with externalMemory()
  std::vector<uint32_t> families;  ///< further queue families that use the buffers
};

struct MemoryStatistics {
  uint64_t used = 0;      ///< total size of existing buffers in bytes
  uint64_t reserved = 0;  ///< total size of all blocks in bytes, including their unused ranges
  uint32_t buffers = 0;
  uint32_t blocks = 0;
};

class Memory;

/// A range of a VkBuffer, usable as a storage buffer, for transfers and indirect commands, and for vertices and
/// indices. The destructor frees the range, so it must run after the last command that uses the range. The Memory must
/// outlive the Buffer.
class Buffer {
 public:
  Buffer() = default;
  Buffer(Buffer&& other) noexcept { *this = std::move(other); }
  Buffer& operator=(Buffer&& other) noexcept;
  ~Buffer();

  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }
  VkBuffer handle() const { return handle_; }
  VkDeviceSize offset() const { return offset_; }  ///< offset in handle(); a multiple of 256
  VkDeviceSize size() const { return size_; }      ///< size in bytes that was requested
  std::byte* data() const { return data_; }        ///< null if not visible to the host
  /// the destructor will free nothing: the range stays reserved until the memory is destroyed
  void forget() noexcept { memory_ = nullptr; }
  /// the buffer's block if MemoryOptions::shared is set; otherwise null
  SharedBlock* block() const;
  /// Call this after the device has written and before the host reads data(). Does nothing if the memory is coherent.
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

/// How another API must import blocks of the device's memory. sharedMemoryNeeds() returns nullopt if the device cannot
/// export its memory.
struct SharedMemoryNeeds {
  /// true: each block must be a dedicated allocation for its single VkBuffer, and must be imported as such
  bool dedicated = false;
};
std::optional<SharedMemoryNeeds> sharedMemoryNeeds(const Device& device);

/// Allocates buffers on a device. Thread-safe. The device must outlive it. The content of a new buffer is undefined.
class Memory {
 public:
  explicit Memory(Device& device, const MemoryOptions& options = {});
  /// Precondition: no buffer exists or is in use.
  ~Memory();
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  /// Allocates a buffer. Errors: out_of_memory (of the device, or of its budget if VK_EXT_memory_budget reports one),
  /// limit (the cap), invalid_argument (0 bytes). After an error nothing has changed, and smaller buffers may still
  /// succeed. Throws std::bad_alloc.
  Result<Buffer> buffer(MemoryKind kind, VkDeviceSize bytes);

  MemoryStatistics statistics() const;

 private:
  friend class Buffer;
  struct Block;
  void give(Buffer& buffer) noexcept;
  /// Frees the buffer's range. Returns its block if the block is no longer needed (the caller must then destroy it),
  /// otherwise null. Precondition: the mutex is held.
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
