#pragma once
// Where kernels run: a GPU (driver_device.h), or loops on the CPU for tests (host_device.h).

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
  int driver = 0;           ///< CUDA's version that it speaks: 1000 * major + 10 * minor; 0: no driver
  uint64_t memory = 0;      ///< bytes
  int clock = 0;            ///< of its multiprocessors at most, kHz
  uint32_t processors = 1;  ///< multiprocessors
  int memory_pools = 0;     ///< 1: memory can be had in a stream's order
  DeviceId id{};
  std::string ails;  ///< why the driver tells no more of it; empty: it does
};

inline constexpr size_t kAlignment = 256;  ///< of what is taken from a device's memory

enum class MemoryKind : uint8_t {
  device,
  pinned  ///< the host's, which the device copies from and to while the host goes on
};

/// Work in order, each piece after those before it; the caller's thread goes on. One thread at a time. Its end waits
/// for what it was given, frees apart. Errors of all that can fail: out_of_memory, device_lost, unsupported.
class Stream {
 public:
  virtual ~Stream() = default;
  /// Bytes at a multiple of kAlignment. What of the device's is freed may be in use by what the stream was given
  /// before; pinned memory is waited for.
  virtual Result<void*> allocate(MemoryKind kind, size_t bytes) = 0;
  virtual void free(MemoryKind kind, void* memory) noexcept = 0;
  /// Between pinned memory and the device's, which stay as they are until the end of the copy.
  virtual Result<void> copyIn(void* device, const void* pinned, size_t bytes) = 0;
  virtual Result<void> copyOut(void* pinned, const void* device, size_t bytes) = 0;
  /// From one place of the device's to another.
  virtual Result<void> copy(void* to, const void* from, size_t bytes) = 0;
  virtual Result<void> clear(void* device, size_t bytes) = 0;
  /// blocks: at least one.
  virtual Result<void> launch(Kernel kernel, uint32_t blocks, const Batch& batch) = 0;
  /// What was given until now is what ended() and wait() speak of, until more is given: a stream of the engine's goes
  /// on with the engine's work.
  virtual Result<void> mark() = 0;
  /// Whether that has ended; does not wait.
  virtual Result<bool> ended() = 0;
  virtual Result<void> wait() = 0;
};

enum class StreamUse : uint8_t {
  own,      ///< nobody else's work is in it
  batches,  ///< where an engine lent a stream, that one
};

/// Another API's memory where the device's kernels and copies reach it. Its end, which does not wait for them, must not
/// come before theirs.
class ImportedMemory {
 public:
  virtual ~ImportedMemory() = default;
  virtual std::byte* data() const = 0;
};

/// Any thread may use it. Outlives its streams; what it has imported may outlive it.
class Device {
 public:
  virtual ~Device() = default;
  virtual const DeviceInfo& info() const = 0;
  virtual Result<std::unique_ptr<Stream>> makeStream(StreamUse use = StreamUse::own) = 0;
  /// Errors: unsupported, out_of_memory, device_lost, and those of SharedBlock::descriptor().
  virtual Result<std::shared_ptr<const ImportedMemory>> import(const SharedBlock&) {
    return Error{Code::unsupported, info().name + " imports no other API's memory"};
  }
  /// Whether an engine lent it, and reads its memory.
  virtual bool borrowed() const { return false; }
  /// Whether something has failed for good: nothing in its memory can be read any more.
  virtual bool lost() const { return false; }
};

/// Memory of a stream, which it does not outlive.
class Memory {
 public:
  Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { reset(); }

  /// At least so many bytes; what was there is lost where it was not enough.
  Result<void> grow(Stream& stream, MemoryKind kind, size_t bytes) {
    if (bytes <= bytes_) return {};
    reset();
    // A quarter more: batches that come after one another are much alike. Pinned memory keeps the whole device waiting
    // when it is taken, and so is taken seldom.
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
