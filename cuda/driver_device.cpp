#include "cuda/driver_device.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "cuda/kernels/kernels.h"

namespace sgm::cuda {

namespace {

constexpr uint64_t kPoolKeeps = uint64_t{256} << 20;  // of what is free, bytes: some batches' worth

Error errorOf(const DriverTable& driver, CuResult result, const std::string& what) {
  const char* text = nullptr;
  if (driver.getErrorString(result, &text) != kCuSuccess || text == nullptr) text = "unknown error";
  const std::string message = what + ": " + text + " (CUresult " + std::to_string(result) + ")";
  switch (result) {
    case kCuOutOfMemory:
      return {Code::out_of_memory, message};
    case kCuNoDevice:
      return {Code::unsupported, "the CUDA driver finds no GPU: " + message};
    case kCuDriverMismatch:
    case kCuUnknownPtx:
    case kCuNoBinary:
      return {Code::unsupported, "the CUDA driver is too old for this build, update it: " + message};
    default:
      // Errors of a context stay with it: whatever failed, only a new one helps.
      return {Code::device_lost, message};
  }
}

/// Makes a context this thread's for as long as it lives.
class Current {
 public:
  Current(const DriverTable& driver, CuContext context)
      : driver_(driver), pushed_(driver.ctxPushCurrent(context) == kCuSuccess) {}
  ~Current() {
    CuContext popped = nullptr;
    if (pushed_) driver_.ctxPopCurrent(&popped);
  }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;
  /// Where not, another's context would take the call.
  explicit operator bool() const { return pushed_; }
  static Error refused() { return {Code::device_lost, "the CUDA context can no longer be used"}; }

 private:
  const DriverTable& driver_;
  const bool pushed_;
};

/// What streams share with their device.
struct Opened {
  const DriverTable driver;
  DeviceInfo info;
  CuContext context = nullptr;
  CuStream stream = nullptr;  ///< the engine's, for all batches; null: each has one of our own
  bool borrowed = false;      ///< the context is the engine's
  mutable std::atomic<bool> lost{false};
  CuModule module = nullptr;
  /// Our own: the device's is shared with the engine, and gives nothing back when a context is lost.
  CuPool pool = nullptr;
  std::array<CuFunction, static_cast<size_t>(Kernel::count)> functions{};

  explicit Opened(const DriverTable& table) : driver(table) {}
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened() {
    if (context == nullptr) return;
    {
      const Current current(driver, context);
      if (current && pool != nullptr) driver.memPoolDestroy(pool);
      if (current && module != nullptr) driver.moduleUnload(module);
    }
    if (!borrowed) driver.ctxDestroy(context);
  }
  Result<void> check(CuResult result, const char* what) const {
    if (result == kCuSuccess) return {};
    const Error error = errorOf(driver, result, std::string(what) + " on " + info.name);
    if (error.code == Code::device_lost) lost.store(true);
    return error;
  }
};

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
  /// event: this stream's from now on.
  DriverStream(const Opened& device, CuStream stream, CuEvent event)
      : device_(device), driver_(device.driver), stream_(stream), event_(event) {}
  ~DriverStream() override {
    static_cast<void>(wait());
    const Current current(driver_, device_.context);
    if (!current) return;
    driver_.eventDestroy(event_);
    if (stream_ != device_.stream) driver_.streamDestroy(stream_);
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
    // Copies may be under way in it. Where nobody can say that they have ended, it is left to the context's end.
    if (device_.lost.load() || (kind == MemoryKind::pinned && !wait())) return;
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
    return device_.check(driver_.memcpyDtoDAsync(pointerOf(to), pointerOf(from), bytes, stream_), "keeping meshes");
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
    // The driver copies the parameters before it returns.
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
    if (const Result<void> asked = device_.check(result, "asking for the batch"); !asked) return asked.error();
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
  /// Who cannot be waited for may write for ever: nothing on the device is to be trusted any more.
  Error unsure(const Error& why) const {
    device_.lost.store(true);
    return {Code::device_lost, why.message};
  }

  const Opened& device_;
  const DriverTable& driver_;
  const CuStream stream_;
  const CuEvent event_;
  bool marked_ = true;  ///< the event stands behind all that was given; where that is nothing, it need not
};

class DriverImport final : public ImportedMemory {
 public:
  static Result<std::shared_ptr<const ImportedMemory>> make(std::shared_ptr<const Opened> device,
                                                            const SharedBlock& block) {
    auto made = std::make_shared<DriverImport>(std::move(device));
    if (const Result<void> imported = made->import(block); !imported) return imported.error();
    return std::shared_ptr<const ImportedMemory>(std::move(made));
  }

  explicit DriverImport(std::shared_ptr<const Opened> device) : device_(std::move(device)) {}
  ~DriverImport() override {
    const Current current(device_->driver, device_->context);
    if (!current) return;
    if (memory_ != 0) device_->driver.memFree(memory_);
    if (imported_ != nullptr) device_->driver.destroyExternalMemory(imported_);
  }
  DriverImport(const DriverImport&) = delete;
  DriverImport& operator=(const DriverImport&) = delete;
  std::byte* data() const override { return reinterpret_cast<std::byte*>(static_cast<uintptr_t>(memory_)); }

 private:
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
  /// Memory that cannot be imported harms no context.
  Error refused(CuResult result) const {
    Error error = errorOf(device_->driver, result, "importing the drawing device's memory on " + device_->info.name);
    if (error.code == Code::device_lost) error.code = Code::unsupported;
    return error;
  }

  const std::shared_ptr<const Opened> device_;
  CuImported imported_ = nullptr;
  CuPointer memory_ = 0;
};

class DriverDevice final : public Device {
 public:
  explicit DriverDevice(std::unique_ptr<Opened> opened) : opened_(std::move(opened)) {}
  const DeviceInfo& info() const override { return opened_->info; }
  bool borrowed() const override { return opened_->borrowed; }
  bool lost() const override { return opened_->lost.load(); }
  Result<std::unique_ptr<Stream>> makeStream(StreamUse use) override {
    const Current current(opened_->driver, opened_->context);
    if (!current) return Current::refused();
    const DriverTable& driver = opened_->driver;
    CuStream stream = use == StreamUse::batches ? opened_->stream : nullptr;
    if (stream == nullptr) {
      const CuResult result = driver.streamCreate(&stream, kCuNonBlockingStream);
      if (const Result<void> made = opened_->check(result, "making a stream"); !made) return made.error();
    }
    CuEvent event = nullptr;
    const CuResult result = driver.eventCreate(&event, kCuEventBlocks | kCuEventUntimed);
    if (const Result<void> made = opened_->check(result, "making an event"); !made) {
      if (stream != opened_->stream) driver.streamDestroy(stream);
      return made.error();
    }
    return std::unique_ptr<Stream>(std::make_unique<DriverStream>(*opened_, stream, event));
  }
  Result<std::shared_ptr<const ImportedMemory>> import(const SharedBlock& block) override {
    return DriverImport::make(opened_, block);
  }

 private:
  std::shared_ptr<Opened> opened_;
};

Result<DeviceInfo> describe(const DriverTable& driver, CuDevice device, int version) {
  DeviceInfo info;
  info.driver = version;
  char name[256] = {};
  size_t bytes = 0;
  int processors = 0;
  const struct {
    int attribute;
    int* value;
  } attributes[] = {{kCuCapabilityMajor, &info.capability_major},
                    {kCuCapabilityMinor, &info.capability_minor},
                    {kCuProcessors, &processors},
                    {kCuMemoryPools, &info.memory_pools}};
  CuResult result = driver.deviceGetName(name, static_cast<int>(sizeof name) - 1, device);
  if (result == kCuSuccess) result = driver.deviceTotalMem(&bytes, device);
  CuId id{};
  if (result == kCuSuccess) result = driver.deviceGetUuid(&id, device);
  for (const auto& one : attributes) {
    if (result == kCuSuccess) result = driver.deviceGetAttribute(one.value, one.attribute, device);
  }
  if (result != kCuSuccess) return errorOf(driver, result, "asking for the CUDA devices");
  info.name = name;
  info.memory = bytes;
  std::copy(std::begin(id.bytes), std::end(id.bytes), info.id.begin());
  info.processors = static_cast<uint32_t>(processors > 0 ? processors : 1);
  return info;
}

Result<void> makeContext(Opened& opened, CuDevice device) {
  const CuResult result = opened.driver.ctxCreate(&opened.context, kCuBlockingWaits, device);
  if (Result<void> made = opened.check(result, "making a context"); !made) return made;
  // A new context is the thread's; the engine's comes back.
  CuContext popped = nullptr;
  opened.driver.ctxPopCurrent(&popped);
  return {};
}

/// What batches need in the context.
Result<void> loadKernels(Opened& opened, CuDevice device, std::span<const std::byte> image) {
  const DriverTable& driver = opened.driver;
  const Current current(driver, opened.context);
  if (!current) return Current::refused();
  if (Result<void> loaded = opened.check(driver.moduleLoadData(&opened.module, image.data()), "loading the kernels");
      !loaded) {
    return loaded;
  }
  CuPoolProperties properties;
  properties.location = device;
  const CuResult pooled = driver.memPoolCreate(&opened.pool, &properties);
  if (Result<void> made = opened.check(pooled, "making a memory pool"); !made) return made;
  // What one batch gives back the next one takes: not by way of the system, at every wait of anyone.
  uint64_t kept_bytes = kPoolKeeps;
  const CuResult told = driver.memPoolSetAttribute(opened.pool, kCuPoolThreshold, &kept_bytes);
  if (Result<void> set = opened.check(told, "setting up a memory pool"); !set) return set;
  static constexpr const char* kNames[] = {
#define SGM_CUDA_KERNEL(Name) "sgm" #Name,
      SGM_CUDA_KERNELS
#undef SGM_CUDA_KERNEL
  };
  static_assert(std::size(kNames) == static_cast<size_t>(Kernel::count));
  for (size_t k = 0; k < std::size(kNames); ++k) {
    const CuResult found = driver.moduleGetFunction(&opened.functions[k], opened.module, kNames[k]);
    if (Result<void> checked = opened.check(found, kNames[k]); !checked) return checked;
  }
  return {};
}

Error noKernels() {
  return {Code::unsupported, "this build has no CUDA kernels: build it where nvcc is, with SGM_CUDA=ON"};
}

/// Before it is open there is no device to be lost: another holds it for itself, say.
Error unusable(const Error& error) {
  return {error.code == Code::device_lost ? Code::unsupported : error.code, error.message};
}

}  // namespace

std::string lackOf(const DeviceInfo& info) {
  if (!info.ails.empty()) return info.ails;
  if (10 * info.capability_major + info.capability_minor < 75) {
    return "it has compute capability " + std::to_string(info.capability_major) + "." +
           std::to_string(info.capability_minor) + ", and 7.5 is the least that works";
  }
  if (info.memory_pools == 0) return "it has no memory pools (cuMemAllocAsync)";
  return {};
}

Result<std::vector<DeviceInfo>> listDevices(const DriverTable& driver) {
  int version = 0, count = 0;
  if (const CuResult result = driver.driverGetVersion(&version); result != kCuSuccess) {
    return errorOf(driver, result, "asking for the CUDA driver's version");
  }
  const CuResult counted = driver.deviceGetCount(&count);
  if (counted != kCuSuccess) return errorOf(driver, counted, "counting the CUDA devices");
  std::vector<DeviceInfo> infos;
  for (int i = 0; i < count; ++i) {
    CuDevice device = 0;
    const CuResult got = driver.deviceGet(&device, i);
    if (got != kCuSuccess) return errorOf(driver, got, "asking for the CUDA devices");
    Result<DeviceInfo> info = describe(driver, device, version);
    // One that is sick keeps nobody from the others.
    if (info) {
      infos.push_back(std::move(*info));
    } else {
      infos.emplace_back().ails = info.error().message;
    }
  }
  return infos;
}

Result<std::vector<DeviceInfo>> listDevices() {
  const Result<DriverTable> driver = openDriver();
  if (!driver) return driver.error();
  return listDevices(*driver);
}

Result<int> findDevice(const DriverTable& driver, const DeviceId& id) {
  const Result<std::vector<DeviceInfo>> infos = listDevices(driver);
  if (!infos) return unusable(infos.error());
  for (size_t i = 0; i < infos->size(); ++i) {
    if ((*infos)[i].ails.empty() && (*infos)[i].id == id) return static_cast<int>(i);
  }
  return Error{Code::unsupported, "the GPU that draws is none of the CUDA driver's"};
}

Result<std::unique_ptr<Device>> openDevice(const DriverTable& driver, std::span<const std::byte> image, int index) {
  if (image.empty()) return noKernels();
  Result<std::vector<DeviceInfo>> infos = listDevices(driver);
  if (!infos) return unusable(infos.error());
  if (infos->empty()) return Error{Code::unsupported, "the CUDA driver finds no GPU"};
  if (index >= static_cast<int>(infos->size())) {
    return Error{Code::unsupported,
                 "there is no CUDA device " + std::to_string(index) + ": there are " + std::to_string(infos->size())};
  }
  size_t chosen = index < 0 ? 0 : static_cast<size_t>(index);
  while (index < 0 && chosen + 1 < infos->size() && !lackOf((*infos)[chosen]).empty()) ++chosen;
  const DeviceInfo& info = (*infos)[chosen];
  if (const std::string lack = lackOf(info); !lack.empty()) {
    return Error{Code::unsupported, info.name + " cannot be used: " + lack};
  }
  auto opened = std::make_unique<Opened>(driver);
  opened->info = info;
  CuDevice device = 0;
  Result<void> made = opened->check(driver.deviceGet(&device, static_cast<int>(chosen)), "opening");
  if (made) made = makeContext(*opened, device);
  if (made) made = loadKernels(*opened, device, image);
  if (!made) return unusable(made.error());
  return std::unique_ptr<Device>(std::make_unique<DriverDevice>(std::move(opened)));
}

Result<std::unique_ptr<Device>> borrowDevice(const DriverTable& driver, std::span<const std::byte> image,
                                             const BorrowedContext& lent) {
  if (image.empty()) return noKernels();
  auto opened = std::make_unique<Opened>(driver);
  opened->borrowed = true;
  opened->context = lent.context;
  opened->stream = lent.stream;
  opened->info.name = "the lent CUDA context";
  CuDevice device = 0;
  int version = 0;
  {
    const Current current(driver, lent.context);
    if (!current) return unusable(Current::refused());
    CuResult result = driver.ctxGetDevice(&device);
    if (result == kCuSuccess) result = driver.driverGetVersion(&version);
    if (Result<void> got = opened->check(result, "asking for the device"); !got) return unusable(got.error());
    CuContext of_stream = lent.context;
    if (lent.stream != nullptr) result = driver.streamGetCtx(lent.stream, &of_stream);
    if (result != kCuSuccess || of_stream != lent.context) {
      return Error{Code::invalid_argument, "the lent stream is none of the lent context's"};
    }
  }
  Result<DeviceInfo> info = describe(driver, device, version);
  if (!info) return unusable(info.error());
  opened->info = std::move(*info);
  if (const std::string lack = lackOf(opened->info); !lack.empty()) {
    return Error{Code::unsupported, opened->info.name + " cannot be used: " + lack};
  }
  if (Result<void> made = loadKernels(*opened, device, image); !made) return unusable(made.error());
  return std::unique_ptr<Device>(std::make_unique<DriverDevice>(std::move(opened)));
}

}  // namespace sgm::cuda
