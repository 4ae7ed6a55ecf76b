#pragma once
// Recording work for the device: a ring of command buffers, each with the descriptor sets that it needs.

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "backend/vulkan/memory.h"
#include "backend/vulkan/pipelines.h"
#include "backend/vulkan/queue.h"

namespace sgm::vulkan {

/// Bytes of a VkBuffer. Bound as storage: offset a multiple of 256, size at most maxStorageBufferRange.
struct BufferRange {
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceSize offset = 0, size = 0;

  BufferRange() = default;
  BufferRange(const Buffer& buffer) : BufferRange(buffer, 0, buffer.size()) {}
  /// Bytes [begin, begin + bytes) of the buffer.
  BufferRange(const Buffer& buffer, VkDeviceSize begin, VkDeviceSize bytes)
      : handle(buffer.handle()), offset(buffer.offset() + begin), size(bytes) {}
};

/// Who touches memory, a bit each.
enum Uses : uint32_t {
  kCompute = 1,   ///< a shader's storage buffers
  kIndirect = 2,  ///< the workgroup counts of dispatchIndirect
  kTransfer = 4,  ///< fill and copy
  kHost = 8,      ///< reading data()
};

class CommandRing;

/// Commands being recorded; without CommandRing::submit they are never run. One thread at a time.
class Commands {
 public:
  Commands(Commands&& other) noexcept;
  Commands& operator=(Commands&&) = delete;
  ~Commands();

  /// The shader, its buffers in the order of their bindings and its push constants for the dispatches that follow: as
  /// many of each as the pipeline was made for. Errors: invalid_argument, out_of_memory (the sets of this recording are
  /// used up, too).
  Result<void> bind(const Pipeline& pipeline, std::span<const BufferRange> buffers, std::span<const std::byte> push);
  /// Workgroups; none of the counts is above maxComputeWorkGroupCount.
  void dispatch(uint32_t x, uint32_t y = 1, uint32_t z = 1);
  /// Their three counts are read from the device's memory; offset a multiple of 4.
  void dispatchIndirect(const BufferRange& counts);
  /// offset and size: multiples of 4.
  void fill(const BufferRange& range, uint32_t word);
  /// As many bytes as `from` has; the two do not overlap.
  void copy(const BufferRange& from, const BufferRange& to);
  /// As many bytes as the range has, which are at most 65,536; its offset and size are multiples of 4.
  void write(const BufferRange& range, std::span<const std::byte> bytes);
  /// What `before` wrote, and has read, is done before `after` reads or writes. What the host wrote before submit()
  /// needs none.
  void barrier(uint32_t before, uint32_t after);
  /// Takes over what another API has written in the ranges (MemoryOptions::shared), for whatever comes after. Throws
  /// std::bad_alloc.
  void acquire(std::span<const BufferRange> ranges);

  VkCommandBuffer handle() const;

 private:
  friend class CommandRing;
  struct Slot;
  Commands(CommandRing& ring, Slot& slot) : ring_(&ring), slot_(&slot) {}

  CommandRing* ring_;
  Slot* slot_;  // null: submitted, or moved from
};

struct CommandRingOptions {
  uint32_t recordings = 4;         ///< at one time, being recorded or run
  uint32_t binds = 256;            ///< of one recording
  uint32_t buffers_of_a_bind = 8;  ///< on average
};

/// Any thread may use it. Takes no memory of the host's once it is made. Outlived by the queue.
class CommandRing {
 public:
  /// Errors: out_of_memory.
  static Result<std::unique_ptr<CommandRing>> create(Queue& queue, const CommandRingOptions& options = {});
  /// Waits for the queue. No recording is left.
  ~CommandRing();
  CommandRing(const CommandRing&) = delete;
  CommandRing& operator=(const CommandRing&) = delete;

  /// Begins a recording; where none is idle, waits at most so many nanoseconds for the next to be. No thread may begin
  /// as many at one time as there are. Errors: limit (none was in time), device_lost, out_of_memory.
  Result<Commands> begin(uint64_t nanoseconds = UINT64_MAX);
  /// Gives the work to the queue, as Queue::submit. Whatever comes of it, the recording has ended.
  Result<uint64_t> submit(Commands commands);

 private:
  friend class Commands;
  explicit CommandRing(Queue& queue);
  Result<void> fill(Commands::Slot& slot, const CommandRingOptions& options);
  Result<Commands::Slot*> findSlot(uint64_t nanoseconds);
  /// Whether one is not being recorded, after at most so long.
  bool awaitRecorded(uint64_t nanoseconds);

  Queue& queue_;
  std::mutex mutex_;
  std::condition_variable recorded_;
  std::vector<Commands::Slot> slots_;
};

}  // namespace sgm::vulkan
