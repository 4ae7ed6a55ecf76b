#pragma once
// The devices that run kernels: a GPU (driver_device.h), or loops on the CPU for tests (host_device.h).

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
  int driver = 0;           ///< supported CUDA version: 1000 * major + 10 * minor; 0: no driver
  uint64_t memory = 0;      ///< bytes
  int clock = 0;            ///< the highest of its multiprocessors, kHz
  uint32_t processors = 1;  ///< multiprocessors
  int memory_pools = 0;     ///< 1: supports stream-ordered allocation
  DeviceId id{};
  std::string ails;  ///< the problem if the driver cannot describe the device; else empty
};

inline constexpr size_t kAlignment = 256;  ///< alignment of allocated device memory

enum class MemoryKind : uint8_t {
  device,
  pinned  ///< host memory for asynchronous copies
};

/// A queue of work that runs in order and asynchronously. One thread at a time. Its destructor waits for the work,
/// except for frees. Errors of all functions: out_of_memory, device_lost, unsupported.
class Stream {
 public:
  virtual ~Stream() = default;
  /// Returns memory aligned to kAlignment. Device memory may be freed while earlier work in the stream uses it; free()
  /// waits for pinned memory.
  virtual Result<void*> allocate(MemoryKind kind, size_t bytes) = 0;
  virtual void free(MemoryKind kind, void* memory) noexcept = 0;
  /// Copy between pinned and device memory; neither may change until the end of the copy.
  virtual Result<void> copyIn(void* device, const void* pinned, size_t bytes) = 0;
  virtual Result<void> copyOut(void* pinned, const void* device, size_t bytes) = 0;
  /// Copies within the device's memory.
  virtual Result<void> copy(void* to, const void* from, size_t bytes) = 0;
  virtual Result<void> clear(void* device, size_t bytes) = 0;
  /// blocks: at least one.
  virtual Result<void> launch(Kernel kernel, uint32_t blocks, const Batch& batch) = 0;
  /// Marks the end of the work so far, for ended() and wait(), until more is added: an engine's stream continues with
  /// the engine's work.
  virtual Result<void> mark() = 0;
  /// Whether the marked work has ended; does not wait.
  virtual Result<bool> ended() = 0;
  virtual Result<void> wait() = 0;
};

enum class StreamUse : uint8_t {
  own,      ///< contains only our work
  batches,  ///< the engine's stream, if it passed one
};

/// Another API's memory, accessible to the device's kernels and copies. Its destructor does not wait for them, and must
/// run after their end.
class ImportedMemory {
 public:
  virtual ~ImportedMemory() = default;
  virtual std::byte* data() const = 0;
};

/// Thread-safe. Must outlive its streams; imported memory may outlive it.
class Device {
 public:
  virtual ~Device() = default;
  virtual const DeviceInfo& info() const = 0;
  virtual Result<std::unique_ptr<Stream>> makeStream(StreamUse use = StreamUse::own) = 0;
  /// Errors: unsupported, out_of_memory, device_lost, and those of SharedBlock::descriptor().
  virtual Result<std::shared_ptr<const ImportedMemory>> import(const SharedBlock&) {
    return Error{Code::unsupported, info().name + " cannot import memory of other APIs"};
  }
  /// Whether it is an engine's (external), which reads its memory.
  virtual bool borrowed() const { return false; }
  /// Whether a permanent failure occurred: nothing in its memory can be read any more.
  virtual bool lost() const { return false; }
};

/// Memory from a stream, which must outlive it.
class Memory {
 public:
  Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { reset(); }

  /// Provides at least this many bytes; loses the content if it must grow.
  Result<void> grow(Stream& stream, MemoryKind kind, size_t bytes) {
    if (bytes <= bytes_) return {};
    reset();
    // With a margin, since successive batches are similar. Allocating pinned memory blocks the whole device, so do it
    // rarely.
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
