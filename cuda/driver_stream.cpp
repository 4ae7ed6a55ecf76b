#include "cuda/driver_stream.h"

#include <unistd.h>

#include <new>

#include "cuda/kernels/kernels.h"

namespace sgm::cuda {

namespace {

uint32_t threadsOf(Kernel kernel) {
  switch (kernel) {
#define SGM_CUDA_KERNEL(Name) \
  case Kernel::Name:          \
    return Name::kThreads;
    SGM_CUDA_KERNELS
#undef SGM_CUDA_KERNEL
    case Kernel::count:
      break;
  }
  return 0;
}

CuPointer pointerOf(const void* device) { return static_cast<CuPointer>(reinterpret_cast<uintptr_t>(device)); }

class DriverStream final : public Stream {
 public:
  explicit DriverStream(const Opened& device) : device_(device), driver_(device.driver) {}
  Result<void> open(StreamUse use) {
    const Current current(driver_, device_.context);
    if (!current) return refused();
    if (use == StreamUse::batches) stream_ = device_.stream;
    if (stream_ == nullptr) {
      const CuResult result = driver_.streamCreate(&stream_, kCuNonBlockingStream);
      if (Result<void> made = device_.check(result, "creating a stream"); !made) return made;
    }
    return device_.check(driver_.eventCreate(&event_, kCuEventBlocks | kCuEventUntimed), "creating an event");
  }
  ~DriverStream() override {
    if (event_ != nullptr) waited();
    const Current current(driver_, device_.context);
    if (!current) return;
    if (event_ != nullptr) driver_.eventDestroy(event_);
    if (stream_ != nullptr && stream_ != device_.stream) driver_.streamDestroy(stream_);
  }

  Result<void*> allocate(MemoryKind kind, size_t bytes) override {
    const Current current(driver_, device_.context);
    if (!current) return refused();
    if (kind == MemoryKind::pinned) {
      void* memory = nullptr;
      const Result<void> made = device_.check(driver_.memHostAlloc(&memory, bytes, 0), "allocating pinned memory");
      if (!made) return made.error();
      return memory;
    }
    CuPointer memory = 0;
    marked_ = false;
    const Result<void> made =
        device_.check(driver_.memAllocFromPoolAsync(&memory, bytes, device_.pool, stream_), "allocating memory");
    if (!made) return made.error();
    return reinterpret_cast<void*>(static_cast<uintptr_t>(memory));
  }
  void free(MemoryKind kind, void* memory) noexcept override {
    const Current current(driver_, device_.context);
    if (!current) return;
    // Copies may still use pinned memory, so wait for them. If waiting fails, the memory is not freed here, but only
    // with the context.
    if (device_.lost.load() || (kind == MemoryKind::pinned && !waited())) return;
    if (kind == MemoryKind::pinned) {
      driver_.memFreeHost(memory);
    } else {
      driver_.memFreeAsync(pointerOf(memory), stream_);
    }
  }
  Result<void> copyIn(void* device, const void* pinned, size_t bytes) override {
    const Current current(driver_, device_.context);
    if (!current) return refused();
    marked_ = false;
    return device_.check(driver_.memcpyHtoDAsync(pointerOf(device), pinned, bytes, stream_), "copying a batch");
  }
  Result<void> copyOut(void* pinned, const void* device, size_t bytes) override {
    const Current current(driver_, device_.context);
    if (!current) return refused();
    marked_ = false;
    return device_.check(driver_.memcpyDtoHAsync(pinned, pointerOf(device), bytes, stream_), "copying meshes");
  }
  Result<void> copy(void* to, const void* from, size_t bytes) override {
    const Current current(driver_, device_.context);
    if (!current) return refused();
    marked_ = false;
    return device_.check(driver_.memcpyDtoDAsync(pointerOf(to), pointerOf(from), bytes, stream_), "storing meshes");
  }
  Result<void> clear(void* device, size_t bytes) override {
    const Current current(driver_, device_.context);
    if (!current) return refused();
    marked_ = false;
    return device_.check(driver_.memsetD8Async(pointerOf(device), 0, bytes, stream_), "clearing memory");
  }
  Result<void> launch(Kernel kernel, uint32_t blocks, const Batch& batch) override {
    const Current current(driver_, device_.context);
    if (!current) return refused();
    marked_ = false;
    // `copy` may be a local variable: the driver reads the parameters before launchKernel returns.
    Batch copy = batch;
    void* parameters[] = {&copy};
    return device_.check(driver_.launchKernel(device_.functions[static_cast<size_t>(kernel)], blocks, 1, 1,
                                              threadsOf(kernel), 1, 1, 0, stream_, parameters, nullptr),
                         "launching a kernel");
  }
  Result<void> mark() override {
    if (marked_) return {};
    const Current current(driver_, device_.context);
    if (!current) return refused();
    const Result<void> recorded = device_.check(driver_.eventRecord(event_, stream_), "marking the end of the batch");
    marked_ = static_cast<bool>(recorded);
    return recorded;
  }
  Result<bool> ended() override {
    if (Result<void> known = mark(); !known) return known.error();
    const Current current(driver_, device_.context);
    if (!current) return refused();
    const CuResult result = driver_.eventQuery(event_);
    if (result == kCuNotReady) return false;
    if (const Result<void> asked = device_.check(result, "querying the batch"); !asked) return asked.error();
    return true;
  }
  Result<void> wait() override {
    if (Result<void> known = mark(); !known) return unsure(known.error());
    const Current current(driver_, device_.context);
    if (!current) return refused();
    const Result<void> waited = device_.check(driver_.eventSynchronize(event_), "waiting for the batch");
    return waited ? waited : unsure(waited.error());
  }

 private:
  Error refused() const {
    device_.lost.store(true);
    return Current::refused();
  }
  /// Returns the error device_lost and marks the device as lost. Used when waiting fails: unfinished work may then
  /// still be writing, so the content of the device's memory is unreliable.
  Error unsure(const Error& why) const {
    device_.lost.store(true);
    return {Code::device_lost, why.message};
  }

  /// Same as wait(), but never throws. wait() may throw while it allocates an error's message; the device then counts
  /// as lost.
  bool waited() noexcept {
    try {
      return static_cast<bool>(wait());
    } catch (const std::bad_alloc&) {
      device_.lost.store(true);
      return false;
    }
  }

  const Opened& device_;
  const DriverTable& driver_;
  CuStream stream_ = nullptr;
  CuEvent event_ = nullptr;
  bool marked_ = true;  ///< true if event_ was recorded after all work in the stream so far, or if the stream has had
                        ///< no work
};

class DriverImport final : public ImportedMemory {
 public:
  explicit DriverImport(std::shared_ptr<const Opened> device) : device_(std::move(device)) {}
  ~DriverImport() override {
    const Current current(device_->driver, device_->context);
    // On a lost device, copies may still use the imported memory, so it is freed only with the context.
    if (!current || device_->lost.load()) return;
    if (memory_ != 0) device_->driver.memFree(memory_);
    if (imported_ != nullptr) device_->driver.destroyExternalMemory(imported_);
  }
  DriverImport(const DriverImport&) = delete;
  DriverImport& operator=(const DriverImport&) = delete;
  std::byte* data() const override { return reinterpret_cast<std::byte*>(static_cast<uintptr_t>(memory_)); }

  Result<void> import(const SharedBlock& block) {
    const Current current(device_->driver, device_->context);
    if (!current) return Current::refused();
    const Result<int> descriptor = block.descriptor();
    if (!descriptor) return descriptor.error();
    CuSharedMemory shared;
    shared.handle.descriptor = *descriptor;
    shared.bytes = block.bytes();
    shared.flags = block.dedicated() ? kCuDedicatedMemory : 0;
    const CuResult taken = device_->driver.importExternalMemory(&imported_, &shared);
    if (taken != kCuSuccess) {
      imported_ = nullptr;
      close(*descriptor);
      return refused(taken);
    }
    CuSharedRange whole;
    whole.bytes = block.bytes();
    const CuResult mapped = device_->driver.externalMemoryGetMappedBuffer(&memory_, imported_, &whole);
    if (mapped == kCuSuccess) return {};
    memory_ = 0;
    return refused(mapped);
  }

 private:
  /// Converts the error of a failed import. If its code is device_lost, changes the code to unsupported, because a
  /// failed import does not affect the context.
  Error refused(CuResult result) const {
    Error error = errorOf(device_->driver, result, "importing the drawing device's memory on " + device_->info.name);
    if (error.code == Code::device_lost) error.code = Code::unsupported;
    return error;
  }

  const std::shared_ptr<const Opened> device_;
  CuImported imported_ = nullptr;
  CuPointer memory_ = 0;
};

}  // namespace

Result<std::unique_ptr<Stream>> makeDriverStream(const Opened& device, StreamUse use) {
  auto stream = std::make_unique<DriverStream>(device);
  if (const Result<void> made = stream->open(use); !made) return made.error();
  return std::unique_ptr<Stream>(std::move(stream));
}

Result<std::shared_ptr<const ImportedMemory>> importMemory(std::shared_ptr<const Opened> device,
                                                           const SharedBlock& block) {
  auto memory = std::make_shared<DriverImport>(std::move(device));
  if (const Result<void> imported = memory->import(block); !imported) return imported.error();
  return std::shared_ptr<const ImportedMemory>(std::move(memory));
}

}  // namespace sgm::cuda
