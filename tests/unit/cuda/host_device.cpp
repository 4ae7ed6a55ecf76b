#include "host_device.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <numeric>
#include <random>
#include <vector>

#include "cuda/kernels/kernels.h"

namespace sgm::cuda {

namespace {

constexpr std::align_val_t kAlignment{256};
constexpr int kNothing = 0xCD;

class HostBlock {
 public:
  HostBlock(uint32_t number, uint32_t count, const std::vector<uint32_t>& threads)
      : number_(number), count_(count), threads_(threads) {}
  uint32_t number() const { return number_; }
  uint32_t count() const { return count_; }
  template <class Phase>
  void each(const Phase& phase) const {
    for (const uint32_t thread : threads_) phase(thread);
  }
  uint32_t scan(uint32_t* values, uint32_t count) const {
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count; ++i) sum += std::exchange(values[i], sum);
    return sum;
  }

 private:
  uint32_t number_, count_;
  const std::vector<uint32_t>& threads_;
};

class HostStream final : public Stream {
 public:
  HostStream(const HostDeviceOptions& options, uint32_t seed) : options_(options), random_(seed) {}

  Result<void*> allocate(MemoryKind, size_t bytes) override {
    if (Result<void> may = before("allocate"); !may) return may.error();
    void* const memory = ::operator new(bytes, kAlignment, std::nothrow);
    if (memory == nullptr) return Error{Code::out_of_memory, "out of memory"};
    std::memset(memory, kNothing, bytes);
    return memory;
  }
  void free(MemoryKind, void* memory) noexcept override { ::operator delete(memory, kAlignment); }
  Result<void> copyIn(void* device, const void* pinned, size_t bytes) override {
    if (Result<void> may = before("copyIn"); !may) return may;
    std::memcpy(device, pinned, bytes);
    return {};
  }
  Result<void> copyOut(void* pinned, const void* device, size_t bytes) override {
    if (Result<void> may = before("copyOut"); !may) return may;
    std::memcpy(pinned, device, bytes);
    return {};
  }
  Result<void> copy(void* to, const void* from, size_t bytes) override {
    if (Result<void> may = before("copy"); !may) return may;
    std::memcpy(to, from, bytes);
    return {};
  }
  Result<void> mark() override { return before("mark"); }
  Result<void> clear(void* device, size_t bytes) override {
    if (Result<void> may = before("clear"); !may) return may;
    std::memset(device, 0, bytes);
    return {};
  }
  Result<void> launch(Kernel kernel, uint32_t blocks, const Batch& batch) override {
    if (Result<void> may = before("launch"); !may) return may;
    switch (kernel) {
#define SGM_CUDA_KERNEL(Name) \
  case Kernel::Name:          \
    run<Name>(blocks, batch); \
    break;
      SGM_CUDA_KERNELS
#undef SGM_CUDA_KERNEL
      case Kernel::count:
        break;
    }
    return {};
  }
  Result<bool> ended() override {
    if (Result<void> may = before("ended"); !may) return may.error();
    return true;
  }
  Result<void> wait() override { return before("wait"); }

 private:
  Result<void> before(const char* call) { return options_.before ? options_.before(call) : Result<void>(); }

  std::vector<uint32_t> inOrder(uint32_t count) {
    std::vector<uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    if (options_.shuffled) std::shuffle(numbers.begin(), numbers.end(), random_);
    return numbers;
  }

  template <class Name>
  void run(uint32_t blocks, const Batch& batch) {
    const auto shared = std::make_unique<typename Name::Shared>();
    for (const uint32_t number : inOrder(blocks)) {
      std::memset(static_cast<void*>(shared.get()), kNothing, sizeof *shared);
      const std::vector<uint32_t> threads = inOrder(Name::kThreads);
      const HostBlock block(number, blocks, threads);
      Name::run(block, batch, *shared);
    }
  }

  const HostDeviceOptions& options_;
  std::mt19937 random_;
};

class HostDevice final : public Device {
 public:
  explicit HostDevice(HostDeviceOptions options) : options_(std::move(options)) {
    info_.name = "CUDA kernels on the CPU";
  }
  const DeviceInfo& info() const override { return info_; }
  bool borrowed() const override { return options_.borrowed; }
  Result<std::unique_ptr<Stream>> makeStream(StreamUse) override {
    if (options_.before) {
      if (Result<void> may = options_.before("makeStream"); !may) return may.error();
    }
    return std::unique_ptr<Stream>(std::make_unique<HostStream>(options_, options_.shuffled.value_or(0)));
  }

 private:
  HostDeviceOptions options_;
  DeviceInfo info_;
};

}  // namespace

std::unique_ptr<Device> makeHostDevice(HostDeviceOptions options) {
  return std::make_unique<HostDevice>(std::move(options));
}

}  // namespace sgm::cuda
