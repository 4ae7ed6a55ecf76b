#include "cuda/driver_device.h"

#include <algorithm>

#include "cuda/driver_stream.h"
#include "cuda/kernels/kernels.h"

namespace sgm::cuda {

namespace {

constexpr uint64_t kPoolKeeps = uint64_t{256} << 20;  // number of free bytes that the memory pool keeps: about the
                                                      // memory of a few batches

class DriverDevice final : public Device {
 public:
  explicit DriverDevice(std::unique_ptr<Opened> opened) : opened_(std::move(opened)) {}
  const DeviceInfo& info() const override { return opened_->info; }
  bool borrowed() const override { return opened_->borrowed; }
  bool lost() const override { return opened_->lost.load(); }
  Result<std::unique_ptr<Stream>> makeStream(StreamUse use) override { return makeDriverStream(*opened_, use); }
  Result<std::shared_ptr<const ImportedMemory>> import(const SharedBlock& block) override {
    return importMemory(opened_, block);
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
                    {kCuClock, &info.clock},
                    {kCuProcessors, &processors},
                    {kCuMemoryPools, &info.memory_pools}};
  CuResult result = driver.deviceGetName(name, static_cast<int>(sizeof name) - 1, device);
  if (result == kCuSuccess) result = driver.deviceTotalMem(&bytes, device);
  for (const auto& one : attributes) {
    if (result == kCuSuccess) result = driver.deviceGetAttribute(one.value, one.attribute, device);
  }
  if (result != kCuSuccess) return errorOf(driver, result, "querying the CUDA devices");
  info.name = name;
  info.memory = bytes;
  // The id is compared with the rendering device's id. Without a UUID the id stays 0, which matches no device of
  // another API.
  CuId id{};
  if (driver.deviceGetUuid(&id, device) == kCuSuccess) {
    std::copy(std::begin(id.bytes), std::end(id.bytes), info.id.begin());
  }
  info.processors = static_cast<uint32_t>(processors > 0 ? processors : 1);
  return info;
}

Result<void> makeContext(Opened& opened, CuDevice device) {
  const CuResult result = opened.driver.ctxCreate(&opened.context, kCuBlockingWaits, device);
  if (Result<void> made = opened.check(result, "creating a context"); !made) return made;
  // cuCtxCreate makes the new context current; restore the context that the caller's thread had before.
  CuContext popped = nullptr;
  opened.driver.ctxPopCurrent(&popped);
  return {};
}

/// Loads the kernels into the context and creates its memory pool.
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
  if (Result<void> made = opened.check(pooled, "creating a memory pool"); !made) return made;
  // Let the pool keep freed memory for the next batch; by default it returns the memory to the system at every
  // synchronization.
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
  return {Code::unsupported, "this build has no CUDA kernels: build it with nvcc installed and SGM_CUDA=ON"};
}

/// Converts an error that occurs while a device is opened. device_lost becomes unsupported, because the device was
/// not open yet. For example, another process may use the device exclusively.
Error unusable(const Error& error) {
  return {error.code == Code::device_lost ? Code::unsupported : error.code, error.message};
}

}  // namespace

std::string unsupportedReason(const DeviceInfo& info) {
  if (!info.problem.empty()) return info.problem;
  if (10 * info.capability_major + info.capability_minor < 75) {
    return "it has compute capability " + std::to_string(info.capability_major) + "." +
           std::to_string(info.capability_minor) + ", but needs at least 7.5";
  }
  if (info.memory_pools == 0) return "it has no memory pools (cuMemAllocAsync)";
  return {};
}

Result<std::vector<DeviceInfo>> listDevices(const DriverTable& driver) {
  int version = 0, count = 0;
  if (const CuResult result = driver.driverGetVersion(&version); result != kCuSuccess) {
    return errorOf(driver, result, "querying the CUDA driver's version");
  }
  const CuResult counted = driver.deviceGetCount(&count);
  if (counted != kCuSuccess) return errorOf(driver, counted, "counting the CUDA devices");
  std::vector<DeviceInfo> infos;
  for (int i = 0; i < count; ++i) {
    CuDevice device = 0;
    const CuResult got = driver.deviceGet(&device, i);
    if (got != kCuSuccess) return errorOf(driver, got, "querying the CUDA devices");
    Result<DeviceInfo> info = describe(driver, device, version);
    // A faulty device must not hide the other devices, so its error is only stored in its DeviceInfo.
    if (info) {
      infos.push_back(std::move(*info));
    } else {
      infos.emplace_back().problem = info.error().message;
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
  for (size_t i = 0; i < infos->size() && id != DeviceId{}; ++i) {
    if ((*infos)[i].problem.empty() && (*infos)[i].id == id) return static_cast<int>(i);
  }
  return Error{Code::unsupported, "the drawing GPU is not a device of the CUDA driver"};
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
  while (index < 0 && chosen + 1 < infos->size() && !unsupportedReason((*infos)[chosen]).empty()) ++chosen;
  const DeviceInfo& info = (*infos)[chosen];
  if (const std::string lack = unsupportedReason(info); !lack.empty()) {
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
                                             const BorrowedContext& external) {
  if (image.empty()) return noKernels();
  auto opened = std::make_unique<Opened>(driver);
  opened->borrowed = true;
  opened->context = external.context;
  opened->stream = external.stream;
  opened->info.name = "the external CUDA context";
  CuDevice device = 0;
  int version = 0;
  {
    const Current current(driver, external.context);
    if (!current) return unusable(Current::refused());
    CuResult result = driver.ctxGetDevice(&device);
    if (result == kCuSuccess) result = driver.driverGetVersion(&version);
    if (Result<void> got = opened->check(result, "querying the device"); !got) return unusable(got.error());
    CuContext of_stream = external.context;
    if (external.stream != nullptr) result = driver.streamGetCtx(external.stream, &of_stream);
    if (result != kCuSuccess || of_stream != external.context) {
      return Error{Code::invalid_argument, "the external stream belongs to another context"};
    }
  }
  Result<DeviceInfo> info = describe(driver, device, version);
  if (!info) return unusable(info.error());
  opened->info = std::move(*info);
  if (const std::string lack = unsupportedReason(opened->info); !lack.empty()) {
    return Error{Code::unsupported, opened->info.name + " cannot be used: " + lack};
  }
  if (Result<void> made = loadKernels(*opened, device, image); !made) return unusable(made.error());
  return std::unique_ptr<Device>(std::make_unique<DriverDevice>(std::move(opened)));
}

}  // namespace sgm::cuda
