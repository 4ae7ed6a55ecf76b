#pragma once
// Records work for the device: a ring of command buffers, each with its descriptor sets.

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

/// Kinds of memory access, a bit each.
enum Uses : uint32_t {
  kCompute = 1,   ///< a shader's storage buffers
  kIndirect = 2,  ///< the workgroup counts of dispatchIndirect
  kTransfer = 4,  ///< fill and copy
  kHost = 8,      ///< reading data()
};

class CommandRing;

/// A recording of commands; they run only if passed to CommandRing::submit. One thread at a time.
class Commands {
 public:
  Commands(Commands&& other) noexcept;
  Commands& operator=(Commands&&) = delete;
  ~Commands();

  /// Sets the shader, its buffers in the order of their bindings, and its push constants for the following dispatches:
  /// as many of each as the pipeline was made for. Errors: invalid_argument, out_of_memory (also if this recording's
  /// sets are used up).
  Result<void> bind(const Pipeline& pipeline, std::span<const BufferRange> buffers, std::span<const std::byte> push);
  /// Workgroup counts; each is at most maxComputeWorkGroupCount.
  void dispatch(uint32_t x, uint32_t y = 1, uint32_t z = 1);
  /// Reads the three counts from device memory; offset a multiple of 4.
  void dispatchIndirect(const BufferRange& counts);
  /// offset and size: multiples of 4.
  void fill(const BufferRange& range, uint32_t word);
  /// Copies as many bytes as `from` has; the two must not overlap.
  void copy(const BufferRange& from, const BufferRange& to);
  /// Writes as many bytes as the range has, at most 65,536; its offset and size are multiples of 4.
  void write(const BufferRange& range, std::span<const std::byte> bytes);
  /// The accesses of `before` finish before `after` reads or writes. Data written by the host before submit() needs no
  /// barrier.
  void barrier(uint32_t before, uint32_t after);
  /// Acquires ranges that another API has written (MemoryOptions::shared), for all later commands. Throws
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
  uint32_t recordings = 4;         ///< concurrent recordings, in recording or running
  uint32_t binds = 256;            ///< per recording
  uint32_t buffers_of_a_bind = 8;  ///< on average
};

/// Thread-safe. Takes no host memory after its creation. The queue must outlive it.
class CommandRing {
 public:
  /// Errors: out_of_memory.
  static Result<std::unique_ptr<CommandRing>> create(Queue& queue, const CommandRingOptions& options = {});
  /// Waits for the queue. Precondition: no recording is left.
  ~CommandRing();
  CommandRing(const CommandRing&) = delete;
  CommandRing& operator=(const CommandRing&) = delete;

  /// Begins a recording; if none is idle, waits at most this long for one. A thread must not hold all recordings and
  /// begin another. Errors: limit (timeout), device_lost, out_of_memory.
  Result<Commands> begin(uint64_t nanoseconds = UINT64_MAX);
  /// Submits the work as Queue::submit. The recording ends, even on error.
  Result<uint64_t> submit(Commands commands);

 private:
  friend class Commands;
  explicit CommandRing(Queue& queue);
  Result<void> fill(Commands::Slot& slot, const CommandRingOptions& options);
  Result<Commands::Slot*> findSlot(uint64_t nanoseconds);
  /// Waits at most this long. Returns whether a slot is not in recording.
  bool awaitRecorded(uint64_t nanoseconds);

  Queue& queue_;
  std::mutex mutex_;
  std::condition_variable recorded_;
  std::vector<Commands::Slot> slots_;
};

}  // namespace sgm::vulkan
