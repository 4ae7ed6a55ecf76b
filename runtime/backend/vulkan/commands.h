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

/// A byte range of a VkBuffer. To be bound as a storage buffer, its offset must be a multiple of 256, and its size at
/// most maxStorageBufferRange.
struct BufferRange {
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceSize offset = 0, size = 0;

  BufferRange() = default;
  BufferRange(const Buffer& buffer) : BufferRange(buffer, 0, buffer.size()) {}
  /// The bytes [begin, begin + bytes) of the buffer.
  BufferRange(const Buffer& buffer, VkDeviceSize begin, VkDeviceSize bytes)
      : handle(buffer.handle()), offset(buffer.offset() + begin), size(bytes) {}
};

/// Kinds of memory accesses for barriers, one bit each.
enum Uses : uint32_t {
  kCompute = 1,   ///< accesses of compute shaders to storage buffers
  kIndirect = 2,  ///< reads of workgroup counts by dispatchIndirect()
  kTransfer = 4,  ///< accesses of fill(), copy() and write()
  kHost = 8,      ///< reads of Buffer::data() by the host
};

class CommandRing;

/// A command buffer that is being recorded. Its commands run only after it is passed to CommandRing::submit. Not
/// thread-safe.
class Commands {
 public:
  Commands(Commands&& other) noexcept;
  Commands& operator=(Commands&&) = delete;
  ~Commands();

  /// Sets the shader for the following dispatches, its buffers in the order of their bindings, and its push constants.
  /// The number of buffers and the size of the push constants must be those for which the pipeline was created. Errors:
  /// invalid_argument; out_of_memory, also if this recording has used up its descriptor sets.
  Result<void> bind(const Pipeline& pipeline, std::span<const BufferRange> buffers, std::span<const std::byte> push);
  /// Runs the shader. x, y, z: numbers of workgroups, each at most maxComputeWorkGroupCount.
  void dispatch(uint32_t x, uint32_t y = 1, uint32_t z = 1);
  /// Runs the shader with numbers of workgroups that are read from device memory; the offset must be a multiple of 4.
  void dispatchIndirect(const BufferRange& counts);
  /// Fills the range with copies of `word`. Its offset and size must be multiples of 4.
  void fill(const BufferRange& range, uint32_t word);
  /// Copies all bytes of `from` to the beginning of `to`. The ranges must not overlap.
  void copy(const BufferRange& from, const BufferRange& to);
  /// Fills the range with the first of the given bytes, at most 65,536. Its offset and size must be multiples of 4.
  void write(const BufferRange& range, std::span<const std::byte> bytes);
  /// Makes the accesses in `before` finish before the accesses in `after` begin. Data that the host wrote before
  /// submit() needs no barrier.
  void barrier(uint32_t before, uint32_t after);
  /// Acquires ranges that another API has written (MemoryOptions::shared) for all later commands. Throws
  /// std::bad_alloc.
  void acquire(std::span<const BufferRange> ranges);

  VkCommandBuffer handle() const;

 private:
  friend class CommandRing;
  struct Slot;
  Commands(CommandRing& ring, Slot& slot) : ring_(&ring), slot_(&slot) {}

  CommandRing* ring_;
  Slot* slot_;  // null after submission or a move
};

struct CommandRingOptions {
  uint32_t recordings = 4;         ///< maximum number of recordings that are in recording or running at the same time
  uint32_t binds = 256;            ///< maximum number of bind() calls per recording
  uint32_t buffers_of_a_bind = 8;  ///< average number of buffers per bind() call
};

/// A ring of command buffers. Thread-safe. Allocates no host memory after its creation. The queue must outlive it.
class CommandRing {
 public:
  /// Creates a ring. Errors: out_of_memory.
  static Result<std::unique_ptr<CommandRing>> create(Queue& queue, const CommandRingOptions& options = {});
  /// Waits for the queue. Precondition: no recording exists.
  ~CommandRing();
  CommandRing(const CommandRing&) = delete;
  CommandRing& operator=(const CommandRing&) = delete;

  /// Begins a recording. If all recordings are in use, waits at most `nanoseconds` until one of them ends. A thread
  /// must not begin another recording while it holds all others. Errors: limit (timeout), device_lost, out_of_memory.
  Result<Commands> begin(uint64_t nanoseconds = UINT64_MAX);
  /// Submits the recording to the queue; returns the value of Queue::submit. The recording ends, even after an error.
  Result<uint64_t> submit(Commands commands);

 private:
  friend class Commands;
  explicit CommandRing(Queue& queue);
  Result<void> fill(Commands::Slot& slot, const CommandRingOptions& options);
  Result<Commands::Slot*> findSlot(uint64_t nanoseconds);
  /// Waits at most this long until some slot is no longer in recording; returns false on a timeout.
  bool awaitRecorded(uint64_t nanoseconds);

  Queue& queue_;
  std::mutex mutex_;
  std::condition_variable recorded_;
  std::vector<Commands::Slot> slots_;
};

}  // namespace sgm::vulkan
