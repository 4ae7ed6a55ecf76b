// Tests that urgent jobs do not wait for a device that is not ready: until it is ready, the CPU meshes them, with the
// same bytes.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "backend/vulkan/kernels.h"
#include "kept_pipelines.h"
#include "spheres.h"
#include "vulkan_machine.h"

using namespace sgm;

namespace {

/// Blocks the creation of pipelines until open() is called. Its state is static, because the device's table holds plain
/// functions: only one Gate may exist at a time.
class Gate {
 public:
  explicit Gate(bool is_open) { state() = {}, state().open = is_open; }

  VulkanMachine machine(vulkan::Engine& engine) {
    return VulkanMachine({}, [&engine] {
      vulkan::BorrowedDevice external = engine.lend();
      external.replace_calls = [](vulkan::DeviceTable& table) {
        vulkan::KeptPipelines::wrap(table);
        state().create = table.vkCreateComputePipelines;
        table.vkCreateComputePipelines = create;
      };
      return vulkan::Device::borrow(external);
    });
  }
  void open() {
    const std::scoped_lock lock(mutex());
    state().open = true;
    changed().notify_all();
  }
  void fail(VkResult result) {
    const std::scoped_lock lock(mutex());
    state().result = result;
  }
  unsigned asked() const {
    const std::scoped_lock lock(mutex());
    return state().asked;
  }
  void awaitAsked(unsigned times) const {
    std::unique_lock lock(mutex());
    changed().wait(lock, [&] { return state().asked >= times; });
  }

 private:
  struct State {
    PFN_vkCreateComputePipelines create = nullptr;
    bool open = false;
    unsigned asked = 0;
    VkResult result = VK_SUCCESS;
  };
  static State& state() {
    static State one;
    return one;
  }
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  static std::condition_variable& changed() {
    static std::condition_variable one;
    return one;
  }
  static VkResult VKAPI_PTR create(VkDevice device, VkPipelineCache cache, uint32_t count,
                                   const VkComputePipelineCreateInfo* info, const VkAllocationCallbacks* allocator,
                                   VkPipeline* pipelines) {
    PFN_vkCreateComputePipelines call = nullptr;
    {
      std::unique_lock lock(mutex());
      ++state().asked;
      changed().notify_all();
      changed().wait(lock, [] { return state().open; });
      if (state().result != VK_SUCCESS) return state().result;
      call = state().create;
    }
    return call(device, cache, count, info, allocator, pipelines);
  }
};

std::vector<ChunkJob> inAHurry(uint32_t seed, uint32_t count) {
  std::vector<ChunkJob> jobs = spheres(seed, count);
  for (ChunkJob& job : jobs) job.prompt = true;
  return jobs;
}

/// Waits until the device accepts urgent jobs; checks the meshes that are made until then.
void awaitReady(const VulkanMachine& machine, const std::vector<ChunkJob>& jobs,
                const std::vector<ChunkMesh>& expected) {
  for (uint64_t before = 1, after = 2; after != before;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    before = machine.vulkan->counters().on_cpu;
    checkSame(expected, meshesOf(*machine.vulkan, jobs));
    after = machine.vulkan->counters().on_cpu;
  }
}

/// Tests that the destruction of a backend waits for the creation of one pipeline at most.
void endEarly(vulkan::Engine& engine) {
  Gate gate(false);
  std::thread opener;
  {
    const VulkanMachine machine = gate.machine(engine);
    REQUIRE(machine);
    const std::vector<ChunkJob> jobs = inAHurry(13, 2);
    (void)meshesOf(*machine.vulkan, jobs);
    gate.awaitAsked(1);
    // After this delay, the backend is usually in its destructor; otherwise the test passes, but proves less.
    opener = std::thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      gate.open();
    });
  }
  opener.join();
  CHECK(gate.asked() <= 2);
}

/// Tests that the CPU meshes until the shaders are ready, and the device afterwards.
void meshUntilReady(vulkan::Engine& engine) {
  Gate gate(false);
  const VulkanMachine machine = gate.machine(engine);
  REQUIRE(machine);
  const uint32_t usual = machine.vulkan->batch();
  CHECK(usual > 1);
  const std::vector<ChunkJob> jobs = inAHurry(11, 6);
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  // While the gate is shut, these calls would never return if they waited for the pipelines.
  for (int round = 1; round <= 3; ++round) {
    checkSame(expected, meshesOf(*machine.vulkan, jobs));
    CHECK(machine.vulkan->counters().on_cpu == jobs.size() * static_cast<size_t>(round));
  }
  CHECK(machine.vulkan->counters().batches == 0);
  CHECK(machine.vulkan->batch() == 1);
  gate.open();
  awaitReady(machine, jobs, expected);
  CHECK(machine.vulkan->counters().batches > 0);
  CHECK(machine.vulkan->batch() == usual);
  CHECK(machine.warnings.empty());
}

/// A job that waits for the device must use the pipelines that are already being made in the background.
void shareWhatIsMade(vulkan::Engine& engine) {
  Gate gate(false);
  const VulkanMachine machine = gate.machine(engine);
  REQUIRE(machine);
  std::vector<ChunkJob> jobs = inAHurry(12, 4);
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  checkSame(expected, meshesOf(*machine.vulkan, jobs));
  CHECK(machine.vulkan->counters().on_cpu == jobs.size());
  gate.awaitAsked(1);
  gate.open();
  for (ChunkJob& job : jobs) job.prompt = false;
  checkSame(expected, meshesOf(*machine.vulkan, jobs));
  CHECK(machine.vulkan->counters().on_cpu == jobs.size());
  CHECK(machine.vulkan->counters().batches == 1);
  CHECK(gate.asked() == vulkan::kernels);
}

/// Tests that shaders which cannot be made cause a line in the log, and no missing mesh.
void failToMake(vulkan::Engine& engine) {
  Gate gate(true);
  const VulkanMachine machine = gate.machine(engine);
  REQUIRE(machine);
  const std::vector<ChunkJob> jobs = inAHurry(14, 3);
  const std::vector<ChunkMesh> expected = meshesOf(*machine.scalar, jobs);
  gate.fail(VK_ERROR_OUT_OF_HOST_MEMORY);
  while (gate.asked() < 3) checkSame(expected, meshesOf(*machine.vulkan, jobs));
  gate.fail(VK_SUCCESS);
  awaitReady(machine, jobs, expected);
  REQUIRE(machine.warnings.size() == 1);
  CHECK(machine.warnings[0].find("the CPU continues to mesh") == 0);
}

}  // namespace

TEST_CASE("jobs in a hurry are meshed by the CPU until the device is ready for them", "[vulkan]") {
  if (!VulkanMachine()) return;
  vulkan::KeptEngine kept;
  // This test comes first, because the pipelines are not cached yet, so that compiling them takes long.
  endEarly(kept.engine);
  meshUntilReady(kept.engine);
  shareWhatIsMade(kept.engine);
  failToMake(kept.engine);
}
