#pragma once
// The interface to a device that runs kernels: a GPU (driver_device.h), or loops on the CPU for tests (host_device.h).

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "base/result.h"
#include "base/shared_memory.h"
#include "cuda/kernels/batch.h"

namespace sgm::cuda {

enum class Kernel : uint8_t {
  Prune,
  Sample,
  CensusBody,
  CensusSeam,
  Allocate,
  BodyVertices,
  SeamVertices,
  ListCells,
  BodyTriangles,
  SeamTriangles,
  SumTriangles,
  count
};

struct DeviceInfo {
  std::string name;
  int capability_major = 0, capability_minor = 0;
  int driver = 0;           ///< newest CUDA version that the driver supports, as 1000 * major + 10 * minor; 0: no
                            ///< driver
  uint64_t memory = 0;      ///< size of the device's memory in bytes
  int clock = 0;            ///< maximum clock of the multiprocessors in kHz
  uint32_t processors = 1;  ///< number of streaming multiprocessors
  int memory_pools = 0;     ///< 1: the device supports stream-ordered allocation; 0: it does not
  DeviceId id{};
  std::string problem;  ///< the reason why the driver could not describe the device; empty if it could
};

inline constexpr size_t kAlignment = 256;  ///< alignment of allocated device memory in bytes

enum class MemoryKind : uint8_t {
  device,
  pinned  ///< page-locked host memory, needed for asynchronous copies
};

/// A queue of asynchronous work that runs in order. Not thread-safe. The destructor waits for the work, except for the
/// freeing of memory. Errors of all functions: out_of_memory, device_lost, unsupported.
class Stream {
 public:
  virtual ~Stream() = default;
  /// Returns memory aligned to kAlignment. free() of device memory is ordered after the earlier work in the stream;
  /// free() of pinned memory blocks until that work has ended.
  virtual Result<void*> allocate(MemoryKind kind, size_t bytes) = 0;
  virtual void free(MemoryKind kind, void* memory) noexcept = 0;
  /// Copies asynchronously from pinned to device memory. Neither range may change until the copy has ended.
  virtual Result<void> copyIn(void* device, const void* pinned, size_t bytes) = 0;
  virtual Result<void> copyOut(void* pinned, const void* device, size_t bytes) = 0;
  /// Copies asynchronously within the device's memory.
  virtual Result<void> copy(void* to, const void* from, size_t bytes) = 0;
  virtual Result<void> clear(void* device, size_t bytes) = 0;
  /// Enqueues a kernel. blocks: number of thread blocks, at least one.
  virtual Result<void> launch(Kernel kernel, uint32_t blocks, const Batch& batch) = 0;
  /// Marks the end of the work that has been enqueued so far; ended() and wait() refer to this mark until more work is
  /// added. In the engine's stream, they thus do not wait for work that the engine enqueues after the mark.
  virtual Result<void> mark() = 0;
  /// Returns true if the marked work has ended. Does not block.
  virtual Result<bool> ended() = 0;
  virtual Result<void> wait() = 0;
};

enum class StreamUse : uint8_t {
  own,      ///< a stream that contains only the library's work
  batches,  ///< the engine's stream, if the engine supplied one; otherwise same as `own`
};

/// Memory of another API, mapped so that this device's kernels and copies can access it. Destroy it only after these
/// have ended: the destructor does not wait for them.
class ImportedMemory {
 public:
  virtual ~ImportedMemory() = default;
  virtual std::byte* data() const = 0;
};

/// A CUDA device, or its simulation on the CPU. Thread-safe. Must outlive its streams; imported memory may outlive it.
class Device {
 public:
  virtual ~Device() = default;
  virtual const DeviceInfo& info() const = 0;
  virtual Result<std::unique_ptr<Stream>> makeStream(StreamUse use = StreamUse::own) = 0;
  /// Makes a memory block of another API accessible to this device. Errors: unsupported, out_of_memory, device_lost,
  /// and those of SharedBlock::descriptor().
  virtual Result<std::shared_ptr<const ImportedMemory>> import(const SharedBlock&) {
    return Error{Code::unsupported, info().name + " cannot import memory of other APIs"};
  }
  /// True if the CUDA context belongs to the engine, which then reads meshes in the device's memory.
  virtual bool borrowed() const { return false; }
  /// True after a permanent failure: the content of the device's memory can no longer be read.
  virtual bool lost() const { return false; }
};

/// Owns memory that was allocated in a stream. The stream must outlive it.
class Memory {
 public:
  Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { reset(); }

  /// Makes the memory at least `bytes` large; if it must grow, its content is lost.
  Result<void> grow(Stream& stream, MemoryKind kind, size_t bytes) {
    if (bytes <= bytes_) return {};
    reset();
    // Allocate more than requested, because the next batch may be slightly larger. Allocation of pinned memory blocks
    // the whole device; rounding its size up to a power of two makes such growth rare.
    bytes = kind == MemoryKind::pinned ? std::bit_ceil(bytes) : bytes + bytes / 4;
    Result<void*> made = stream.allocate(kind, bytes);
    if (!made) return made.error();
    stream_ = &stream;
    kind_ = kind;
    data_ = static_cast<std::byte*>(*made);
    bytes_ = bytes;
    return {};
  }
  void reset() noexcept {
    if (data_ != nullptr) stream_->free(kind_, data_);
    data_ = nullptr;
    bytes_ = 0;
  }
  std::byte* data() const { return data_; }
  size_t bytes() const { return bytes_; }

 private:
  Stream* stream_ = nullptr;
  MemoryKind kind_ = MemoryKind::device;
  std::byte* data_ = nullptr;
  size_t bytes_ = 0;
};

}  // namespace sgm::cuda
