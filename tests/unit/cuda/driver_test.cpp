// Tests how the CUDA backend uses the driver, on a simulated driver: everything that is opened is closed, unusable
// devices are rejected with a reason, and the meshes are right whichever call fails.

#include <array>
#include <random>

#include "backend/cpu/cpu_backend.h"
#include "catch.h"
#include "cuda/cuda_backend.h"
#include "cuda/driver_device.h"
#include "fake_driver.h"
#include "rounds.h"
#include "unit/backend/spheres.h"

using namespace sgm;
using cuda::FakeDriver;

namespace {

Result<std::unique_ptr<cuda::Device>> open(const FakeDriver& driver, int index = -1) {
  return cuda::openDevice(driver.table(), cuda::kFakeImage, index);
}

std::string refusal(const FakeDriver& driver, int index = -1) {
  const auto device = open(driver, index);
  REQUIRE(!device);
  CHECK(device.error().code == Code::unsupported);
  return device.error().message;
}

struct FakeMachine {
  FakeDriver driver;
  std::unique_ptr<JobSystem> jobs = *makeThreadPool(2);
  std::unique_ptr<Backend> scalar = *makeCpuBackend("scalar", *jobs, std::pmr::get_default_resource(), {});
  std::unique_ptr<Backend> cuda;
  std::vector<std::string> warnings;
  unsigned opened = 0;

  FakeMachine() {
    CudaBackendOptions options;
    options.warn = [this](const std::string& text) { warnings.push_back(text); };
    options.open = [this] {
      ++opened;
      return open(driver);
    };
    Result<std::unique_ptr<Backend>> made =
        makeCudaBackend(options, *makeCpuBackend("", *jobs, std::pmr::get_default_resource(), {}),
                        std::pmr::get_default_resource(), {});
    REQUIRE(made);
    cuda = std::move(*made);
  }
};

}  // namespace

TEST_CASE("chunks are meshed through the driver, and nothing is left behind", "[cuda]") {
  FakeMachine machine;
  std::vector<ChunkJob> jobs = spheres(21, 20);
  checkSame(meshesOf(*machine.scalar, jobs), meshesOf(*machine.cuda, jobs));
  CHECK(machine.cuda->counters().on_cpu == 0);
  // A batch launches every kernel once, except the kernel for chunks of which only measures are requested (sums_only).
  constexpr auto kAll = static_cast<uint64_t>(cuda::Kernel::count);
  CHECK(machine.driver.state().launches == kAll - 1);
  jobs[3].sums_only = true;
  CHECK(meshesOf(*machine.cuda, jobs)[3].sums == meshesOf(*machine.scalar, jobs)[3].sums);
  CHECK(machine.driver.state().launches == 2 * kAll - 1);
  CHECK(machine.cuda->capabilities().device == "a GPU that pretends");
}

TEST_CASE("a driver or device that cannot be used is refused with the reason", "[cuda]") {
  const FakeDriver driver;
  FakeDriver::State& state = driver.state();
  CHECK(cuda::openDevice(driver.table(), {}).error().message.find("no CUDA kernels") != std::string::npos);
  CHECK(refusal(driver, 3).find("there is no CUDA device 3") == 0);
  state.devices = 0;
  CHECK(refusal(driver) == "the CUDA driver finds no GPU");
  state.devices = 2;
  state.capability_major = 7, state.capability_minor = 0;
  CHECK(refusal(driver).find("compute capability 7.0") != std::string::npos);
  state.capability_minor = 5;
  CHECK(open(driver));
  state.memory_pools = 0;
  CHECK(refusal(driver).find("memory pools") != std::string::npos);
  state.memory_pools = 1;
  for (const int old : {cuda::kCuDriverMismatch, cuda::kCuNoBinary, cuda::kCuUnknownPtx}) {
    state.fail_call = "moduleLoadData", state.fail_nth = 1, state.fail_result = old;
    CHECK(refusal(driver).find("too old") != std::string::npos);
  }
  state.devices = 1;
  for (const char* call : {"driverGetVersion", "deviceGetCount", "deviceGet", "deviceGetName", "deviceTotalMem",
                           "deviceGetAttribute", "ctxCreate", "moduleLoadData", "memPoolCreate", "moduleGetFunction"}) {
    CAPTURE(call);
    state.fail_call = call, state.fail_nth = 1, state.fail_result = cuda::kCuOutOfMemory;
    if (std::string(call) != "deviceGetName" && std::string(call) != "deviceTotalMem" &&
        std::string(call) != "deviceGetAttribute") {
      const auto device = open(driver);
      REQUIRE(!device);
      CHECK(device.error().code == Code::out_of_memory);
      CHECK(device.error().message.find("out of memory") != std::string::npos);
    }
    // Any error other than a lack of memory makes the device unusable, including the unknown code 46.
    state.fail_nth = 1, state.fail_result = 46;
    CHECK(refusal(driver).find("a failure") != std::string::npos);
  }
  // If one device is unusable, the next one is used.
  state.devices = 2;
  state.fail_call = "deviceGetName", state.fail_nth = 1, state.fail_result = 999;
  CHECK(open(driver));
}

TEST_CASE("whatever call of the driver fails, the meshes are right and the next batch finds a device", "[cuda]") {
  FakeMachine machine;
  const std::vector<ChunkJob> jobs = spheres(22, 4);
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  constexpr uint32_t kSeed = 20'260'102;
  std::mt19937 random(kSeed);
  FakeDriver::State& state = machine.driver.state();
  uint64_t struck = 0;
  for (uint32_t round = 0; round < rounds(150); ++round) {
    static const char* const kCalls[] = {"memAllocFromPoolAsync", "memHostAlloc", "memcpyHtoDAsync",  "memcpyDtoHAsync",
                                         "memsetD8Async",         "launchKernel", "eventSynchronize", "eventQuery",
                                         "streamCreate",          "eventRecord",  "eventCreate"};
    state.fail_call = kCalls[random() % std::size(kCalls)];
    state.fail_nth = 1 + static_cast<unsigned>(random() % 9);
    state.fail_result = random() % 2 == 0 ? cuda::kCuOutOfMemory : 700;  // 700: an illegal address
    state.lasts = random() % 2 == 0;
    CAPTURE(kSeed, round, state.fail_call, state.fail_nth, state.fail_result, state.lasts);
    const BackendCounters before = machine.cuda->counters();
    checkSame(expected, random() % 2 == 0 ? polled(*machine.cuda, jobs) : meshesOf(*machine.cuda, jobs));
    struck += machine.cuda->counters().on_cpu - before.on_cpu;
    state.fail_nth = 0;
    // After a loss, the device is opened again, and everything works as before.
    checkSame(expected, meshesOf(*machine.cuda, jobs));
    const uint64_t after = machine.cuda->counters().on_cpu;
    checkSame(expected, meshesOf(*machine.cuda, jobs));
    CHECK(machine.cuda->counters().on_cpu == after);
  }
  CHECK(struck > 0);
}

TEST_CASE("a context that cannot be made current takes no call", "[cuda]") {
  FakeMachine machine;
  const std::vector<ChunkJob> jobs = spheres(23, 3);
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  FakeDriver::State& state = machine.driver.state();
  // The backend may leave objects behind in a context that cannot be made current: destroying the context releases
  // them.
  state.may_leave = true;
  for (unsigned nth = 1; nth < 40; ++nth) {
    CAPTURE(nth);
    state.fail_call = "ctxPushCurrent", state.fail_nth = nth, state.fail_result = 201, state.lasts = nth % 2 == 0;
    checkSame(expected, meshesOf(*machine.cuda, jobs));
    state.fail_nth = 0;
    checkSame(expected, meshesOf(*machine.cuda, jobs));
  }
  CHECK(machine.cuda->counters().device_lost > 0);
}

TEST_CASE("a device that is lost time and again is left alone, and every loss is told", "[cuda]") {
  FakeMachine machine;
  const std::vector<ChunkJob> jobs = spheres(24, 3);
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  FakeDriver::State& state = machine.driver.state();
  state.fail_call = "launchKernel", state.fail_nth = 1, state.fail_result = 719, state.lasts = true;
  for (int batch = 0; batch < 20; ++batch) checkSame(expected, meshesOf(*machine.cuda, jobs));
  CHECK(machine.opened == 8);
  CHECK(machine.cuda->counters().device_lost == 8);
  CHECK(machine.cuda->counters().on_cpu == 20 * jobs.size());
  REQUIRE(machine.warnings.size() == 9);
  CHECK(machine.warnings[0].find("a GPU that pretends was lost, and the CPU continues: launching a kernel") == 0);
  CHECK(machine.warnings[8].find("is no longer used") != std::string::npos);
}
